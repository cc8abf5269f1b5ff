#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints accuracy.md from the folder that accuracy.sh fills."""

import csv
import os
import sys
from pathlib import Path

import numpy as np

from fit_same_place import SHARES, Pairs

SETS = {
    "corridor": "corridor",
    "gardens-day": "GardensPoint, day, 2 m aside",
    "gardens-night": "GardensPoint, night, 2 m aside",
    "hololens": "HoloLens lounge",
    "tum-xyz": "TUM fr1_xyz",
    "euroc": "EuRoC V1_01, sparse",
    "kitti03-twice": "KITTI 03, driven twice",
    "kitti03-once": "KITTI 03, straight through",
    "office-tower": "office tower, between floors",
    "town": "town",
    "town-hard": "harder town",
}
CONFIGS = {
    "fild_paper": "paper",
    "default": "default",
    "look_ahead": "default, 10 s ahead",
    "left_out": "**left out**",
}
COLUMNS = {
    "precision": "precision",
    "recall": "recall",
    "recall_at_full_precision_inliers": "recall at P = 1, by inliers",
    "segment_recall": "segment recall",
    "wrong": "wrong loops",
    "worst_wrong_support": "worst wrong, support",
}


def read_points(folder):
    path = folder / "sweep.csv"
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text, key):
    if key == "wrong":
        return f"{float(text):.1f}".removesuffix(".0")
    return f"{float(text):.3f}"


def cell(point, key):
    """The mean, and the range where seeds differ."""
    if not point.get(key):
        return "-"
    mean, least, most = (number(point[name], key) for name in (key, key + "_min", key + "_max"))
    return mean if least == most else f"{mean} [{least}, {most}]"


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def main_table(folder):
    yield row("set", "configuration", *COLUMNS.values())
    yield "|" + "---|" * (2 + len(COLUMNS))
    for name, title in SETS.items():
        for config, config_title in CONFIGS.items():
            for point in read_points(folder / name / config):
                yield row(title, config_title, *(cell(point, key) for key in COLUMNS))


def area_under_curve(right, wrong):
    """The probability that a right pair has a greater value than a wrong one."""
    if len(right) == 0 or len(wrong) == 0:
        return None
    values = np.concatenate([right, wrong])
    _, ranks, counts = np.unique(values, return_inverse=True, return_counts=True)
    ranks = (np.cumsum(counts) - (counts - 1) / 2)[ranks]
    return (ranks[:len(right)].sum() - len(right) * (len(right) + 1) / 2) / (len(right) * len(wrong))


def evidence_table(folder):
    """Each kind of evidence alone: the area under the curve of right pairs against wrong ones of the
    same set, and against the look-alikes of the office tower."""
    sets = {name: Pairs(folder / name / "pairs") for name in SETS
            if (folder / name / "pairs" / "sweep_pairs.csv").exists()}
    named = [name for name, pairs in sets.items() if (pairs.truth == 1).sum() > 20]
    office = sets["office-tower"]
    alike = (office.truth == 0) & (office.inliers >= 20)
    yield row("evidence", *(SETS[name] for name in named))
    yield "|" + "---|" * (1 + len(named))
    for i, kind in enumerate(["inliers"] + SHARES):
        cells = []
        for name in named:
            right = sets[name].features[sets[name].truth == 1, i]
            own = area_under_curve(right, sets[name].features[sets[name].truth == 0, i])
            against = area_under_curve(right, office.features[alike, i])
            cells.append(f"{'-' if own is None else f'{own:.2f}'} / {against:.2f}")
        yield row(f"`{kind}`", *cells)


def main():
    folder = Path(sys.argv[1])
    seeds = os.environ["SEEDS"]
    print(f"""# Accuracy

Made by `tests/benchmark/accuracy.sh`: the detector on real and rendered sets, with the paper's configuration
(`fild_paper.ini`) and ours (`default.ini`), the network of `get-model.sh`, seeds {seeds}. Mean [least, greatest] over the
seeds; one number where they agree. No set has settings of its own but the delay: 20 s, 8 s on HoloLens, 10 s on TUM fr1_xyz,
which are shorter. **Left out** is the row that counts: `default.ini` with the coefficients of `[same_place]` fitted to the
*other* sets only.

* **corridor**: an office corridor, walked twice; a loop is right when it is labelled.
* **GardensPoint**: one walk by day, then again 2 m to the side, by day or by night; right within 3 pictures.
* **HoloLens lounge**: wide baselines; right when the views overlap by 40 %.
* **TUM fr1_xyz**: one desk; right within 0.5 m and 45 degrees. All views overlap, so no loop is wrong.
* **EuRoC V1_01**: 100 frames over 135 s; right within 2.5 m and 45 degrees, wrong from 4 m or 90 degrees.
* **KITTI 03**: even frames, then odd ones; right within 5 m and 45 degrees, wrong from 30 m or 90 degrees. Straight through
  nothing is revisited.
* **office tower**: floors that look alike; every loop between floors is wrong, within a floor nobody knows.
* **town**, **harder town**: `synthetic-rawlog --preset demo` and `--preset hard`; right when the overlap of the views says so.

`worst wrong`: the greatest support of a wrong candidate that a frame reported. In the rows of `default.ini` it is a
probability, accepted from `min_probability` on; in those of the paper inliers / tau.
""")
    print("\n".join(main_table(folder)))
    print("""
## Each kind of evidence alone

Area under the curve of right pairs against wrong ones of the same set / against look-alikes with 20 inliers or more between
the floors of the office tower; 1 separates them, 0.5 says nothing, below 0.5 speaks against a place. All candidates of all
frames that have 8 inliers.
""")
    print("\n".join(evidence_table(folder)))


if __name__ == "__main__":
    main()
