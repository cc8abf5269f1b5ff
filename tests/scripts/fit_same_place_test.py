#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of tests/benchmark/fit_same_place.py on pairs drawn by lot."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

SCRIPT = Path(__file__).resolve().parents[1] / "benchmark" / "fit_same_place.py"
SHARES = ["inlier_share", "shape_share", "match_share", "close_share", "overlap_share"]


def write_pairs(folder, kinds, seed):
    """kinds: (number of pairs, truth, inliers, share of inliers, share of close matches)."""
    lot = np.random.RandomState(seed)
    folder.mkdir()
    with open(folder / "sweep_pairs.csv", "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["seed", "frame", "candidate", "rank", "matches", "inliers", *SHARES,
                       "against_chance", "against_look_alike", "truth"])
        frame = 0
        for count, truth, inliers, inlier_share, close_share in kinds:
            for _ in range(count):
                frame += 1
                shares = dict.fromkeys(SHARES, 0.5)
                shares["inlier_share"] = np.clip(lot.normal(inlier_share, 0.05), 0.01, 0.99)
                shares["close_share"] = np.clip(lot.normal(close_share, 0.05), 0.01, 0.99)
                rows.writerow([1, frame, 0, 1, 100, max(8, int(lot.normal(inliers, inliers / 4))),
                               *shares.values(), 0, 0, truth])


def run(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True,
                          text=True, check=False)


class FitSamePlace(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = Path(self.folder.name)
        write_pairs(root / "street", [(200, 1, 60, 0.6, 0.4), (300, 0, 11, 0.2, 0.4)], 1)
        write_pairs(root / "floors", [(200, 0, 60, 0.4, 0.8), (200, 0, 11, 0.2, 0.4)], 2)
        self.sets = [f"{name}={root / name}" for name in ("street", "floors")]

    def tearDown(self):
        self.folder.cleanup()

    def fit(self, *arguments):
        done = run(*self.sets, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return dict(line.split(" = ") for line in done.stdout.splitlines())

    def test_learns_what_tells_the_classes_apart(self):
        fitted = {key: float(value) for key, value in self.fit("--look-alikes", "floors").items()}
        self.assertEqual(len(fitted), 14)
        self.assertGreater(fitted["chance_inliers"] + fitted["chance_inlier_share"], 1)
        self.assertGreater(fitted["look_alike_inlier_share"], 0.5)
        self.assertLess(fitted["look_alike_close_share"], -0.5)

        def score(prefix, inliers, inlier_share, close_share):
            odds = lambda p: np.log(p / (1 - p))
            return (fitted[prefix + "bias"] + fitted[prefix + "inliers"] * np.log(inliers - 6)
                    + fitted[prefix + "inlier_share"] * odds(inlier_share)
                    + fitted[prefix + "close_share"] * odds(close_share))

        self.assertGreater(score("chance_", 60, 0.6, 0.4), 2)
        self.assertLess(score("chance_", 11, 0.2, 0.4), -2)
        self.assertGreater(score("look_alike_", 60, 0.6, 0.4), 2)
        self.assertLess(score("look_alike_", 60, 0.4, 0.8), -2)

    def test_never_gives_a_sign_that_the_options_refuse(self):
        for key, value in self.fit("--look-alikes", "floors").items():
            share = key.split("_", 2)[-1] if key.startswith("look_alike") else key.split("_", 1)[-1]
            if "bias" in key:
                continue
            against = key.startswith("look_alike_") and share in (
                "close_share", "overlap_share")
            self.assertTrue(float(value) <= 0 if against else float(value) >= 0, key)

    def test_says_what_is_missing(self):
        done = run(*self.sets, "--look-alikes", "floors", "--without", "floors")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no set of look-alikes is left", done.stderr)

    def test_prints_overrides(self):
        done = run(*self.sets, "--look-alikes", "floors", "--as-overrides")
        self.assertEqual(done.stdout.count("--set same_place."), 14)


if __name__ == "__main__":
    unittest.main()
