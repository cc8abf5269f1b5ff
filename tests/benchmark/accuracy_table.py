#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints accuracy.md from the folder that accuracy.sh fills."""

import csv
import os
import sys
from pathlib import Path

SETS = {
    "corridor": "corridor",
    "town": "town",
    "kitti03-twice": "KITTI 03, driven twice",
    "kitti03-once": "KITTI 03, straight through",
}
CONFIGS = {"fild_paper": "paper", "default": "default"}
NETWORKS = ["npm", "ImageNet"]
COLUMNS = {
    "precision": "precision",
    "recall": "recall",
    "recall_at_full_precision_inliers": "recall at P = 1",
    "segment_recall": "segment recall",
    "wrong": "wrong loops",
    "worst_wrong_support": "worst wrong, support",
    "worst_wrong_inliers": "inliers",
}


def read_points(folder):
    with open(folder / "sweep.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text, key):
    if key in ("wrong", "worst_wrong_inliers"):
        return f"{float(text):.1f}".removesuffix(".0")
    if key == "worst_wrong_support":
        return f"{float(text):.2f}"
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
    yield row("set", "configuration", "network", *COLUMNS.values())
    yield "|" + "---|" * (3 + len(COLUMNS))
    for name, title in SETS.items():
        for config, config_title in CONFIGS.items():
            for network in NETWORKS:
                [point] = read_points(folder / name / f"{config}-{network}")
                yield row(title, config_title, network, *(cell(point, key) for key in COLUMNS))


def changes_table(folder):
    """Recall and the worst wrong pair on every set."""
    yield row("changed", *(f"{title} | worst" for title in SETS.values()))
    yield "|" + "---|" * (1 + 2 * len(SETS))
    for points in zip(*(read_points(folder / name / "changes") for name in SETS)):
        cells = []
        for point in points:
            wrong = "" if float(point["wrong_max"]) == 0 else f", **{cell(point, 'wrong')} wrong**"
            cells.append(cell(point, "recall") + wrong)
            cells.append(cell(point, "worst_wrong_support"))
        yield row("<br>".join(f"`{word}`" for word in points[0]["changed"].split()), *cells)


def main():
    folder = Path(sys.argv[1])
    seeds, few_seeds = os.environ["SEEDS"], os.environ["FEW_SEEDS"]
    print(f"""# Accuracy

Made by `tests/benchmark/accuracy.sh`: the detector on four sets, with the paper's configuration (`fild_paper.ini`) and ours
(`default.ini`), the network of `get-model.sh` (npm) and an ImageNet MobileNetV2, delay 20 s, seeds {seeds}. Mean
[least, greatest] over the seeds; one number where they agree. No set has settings of its own.

* **corridor**: 84 images of an office corridor, walked twice; a loop is right when it is labelled.
* **town**: `synthetic-rawlog --preset demo`, with look-alike houses and light that changes between the laps; a loop is
  right when the overlap of the views says so (`exact`).
* **KITTI 03, driven twice**: even frames, then odd ones; a loop is right within 5 m and 45 degrees.
* **KITTI 03, straight through**: nothing is revisited, so every loop is wrong and there is no recall.

`worst wrong`: the wrong candidate that came nearest to being accepted: what speaks for it as a share of what is asked for
(1 is the threshold), and its inliers.
""")
    print("\n".join(main_table(folder)))
    print(f"""
## One option at a time

`default.ini` with one thing as in the paper; npm network. Recall and the support of the worst wrong pair; corridor with
seeds {seeds}, the others with {few_seeds}. An option stays in `default.ini` when taking it out costs
recall, or margin against wrong loops, on some set.
""")
    print("\n".join(changes_table(folder)))


if __name__ == "__main__":
    main()
