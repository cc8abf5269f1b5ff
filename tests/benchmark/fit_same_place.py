#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits the coefficients of [same_place] to labelled runs and prints them as lines of an .ini file.

    fit_same_place.py SET=FOLDER... [--look-alikes SET,...] [--without SET]
                      [--as-overrides]

FOLDER holds the sweep_pairs.csv of `loop-closure-eval --rawlog ... --output FOLDER`. Wrong pairs with fewer
than 20 inliers teach what chance does; those of the --look-alikes sets with more, what look-alikes are; those
of other sets are neighbours of the truth and teach nothing. Each set counts as much as any other; --without leaves one out.
--as-overrides prints arguments for --set instead."""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np

SHARES = ["inlier_share", "shape_share", "match_share", "close_share", "overlap_share"]
# What a greater number says: 1 for one place, -1 against it, 0 left out.
CHANCE_SIGNS = np.array([1, 0, 0, 1, 0, 0])
LOOK_ALIKE_SIGNS = np.array([0, 1, -1, 1, -1, -1])
LEAST_SHARE = 0.003
CLEAR_INLIERS = 15  # a true pair with fewer is not clear enough to learn from
LOOK_ALIKE_INLIERS = 20
REPORTED_INLIERS = 12


class Pairs:
    """The pairs of one set: features, truth (1, 0), query and inliers."""

    def __init__(self, folder):
        with open(Path(folder) / "sweep_pairs.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["truth"]]
        shares = np.array([[float(row[name]) for name in SHARES] for row in rows]).reshape(-1, len(SHARES))
        shares = np.clip(shares, LEAST_SHARE, 1 - LEAST_SHARE)
        self.inliers = np.array([int(row["inliers"]) for row in rows])
        self.features = np.column_stack([np.log(np.maximum(self.inliers - 6, 1)),
                                         np.log(shares / (1 - shares))])
        self.truth = np.array([int(row["truth"]) for row in rows])
        self.query = np.array([f"{row['seed']}/{row['frame']}" for row in rows])


def logistic(groups, signs, ridge):
    """Logistic regression with coefficients of the given signs. `groups`: (features, class);
    a group counts as much as any other, however many rows it has, and both classes count the same."""
    groups = [group for group in groups if len(group[0])]
    x = np.concatenate([features for features, _ in groups])
    y = np.concatenate([np.full(len(features), float(label)) for features, label in groups])
    w = np.concatenate([np.full(len(features), 1 / len(features)) for features, _ in groups])
    for label in (0, 1):
        w[y == label] /= 2 * w[y == label].sum()
    used = np.flatnonzero(signs)
    mean, deviation = w @ x[:, used], None
    deviation = np.sqrt(w @ (x[:, used] - mean) ** 2) + 1e-9
    z = (x[:, used] - mean) / deviation * signs[used]
    z = np.column_stack([np.ones(len(z)), z])
    penalty = np.full(z.shape[1], ridge)
    penalty[0] = 0
    # Accelerated projected gradient (Beck & Teboulle 2009); the loss has curvature of at most this.
    curvature = np.linalg.eigvalsh((z * w[:, None]).T @ z)[-1] / 4 + 2 * ridge
    b = previous = np.zeros(z.shape[1])
    momentum = 1.0
    for _ in range(20000):
        step = (1 + np.sqrt(1 + 4 * momentum ** 2)) / 2
        ahead = b + (momentum - 1) / step * (b - previous)
        gradient = z.T @ (w * (1 / (1 + np.exp(-z @ ahead)) - y)) + 2 * penalty * ahead
        previous, b = b, ahead - gradient / curvature
        b[1:] = np.maximum(b[1:], 0)
        momentum = step
        if np.abs(b - previous).max() < 1e-7:
            break
    coefficients = np.zeros(len(signs))
    coefficients[used] = b[1:] / deviation * signs[used]
    return coefficients, b[0] - coefficients[used] @ mean


def best_pairs(pairs, score):
    """Of each query the row with the greatest score."""
    best = {}
    for i, query in enumerate(pairs.query):
        if query not in best or score[i] > score[best[query]]:
            best[query] = i
    return np.array(sorted(best.values()), dtype=int)


def fit_chance(sets):
    groups = []
    for name, p in sets.items():
        clear = (p.truth == 1) & (p.inliers >= CLEAR_INLIERS)
        wrong = (p.truth == 0) & (p.inliers < LOOK_ALIKE_INLIERS)
        groups += [(p.features[clear], 1), (p.features[wrong], 0)]
    coefficients, bias = logistic(groups, CHANCE_SIGNS, 1e-5)
    # Again with the best pair of each query alone: what the detector has to decide.
    groups = []
    for name, p in sets.items():
        score = p.features @ coefficients + bias
        best = best_pairs(p, score)
        right = best[(p.truth[best] == 1) & (p.inliers[best] >= REPORTED_INLIERS)]
        wrong = best[(p.truth[best] == 0) & (p.inliers[best] < LOOK_ALIKE_INLIERS)]
        groups += [(score[right][:, None], 1), (score[wrong][:, None], 0)]
    slope, offset = logistic(groups, np.array([1]), 1e-6)
    return coefficients * slope[0], bias * slope[0] + offset


def fit_look_alikes(sets, look_alikes):
    groups = []
    for name, p in sets.items():
        clear = (p.truth == 1) & (p.inliers >= CLEAR_INLIERS)
        groups.append((p.features[clear], 1))
        if name in look_alikes:
            alike = (p.truth == 0) & (p.inliers >= LOOK_ALIKE_INLIERS)
            groups.append((p.features[alike], 0))
    return logistic(groups, LOOK_ALIKE_SIGNS, 1e-4)


def lines(prefix, coefficients, bias):
    yield f"{prefix}bias", bias
    yield from zip([prefix + name for name in ["inliers"] + SHARES], coefficients)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("sets", nargs="+")
    parser.add_argument("--look-alikes", default="")
    parser.add_argument("--without", default="")
    parser.add_argument("--as-overrides", action="store_true")
    options = parser.parse_args()
    sets = dict(argument.split("=", 1) for argument in options.sets)
    sets = {name: Pairs(folder) for name, folder in sets.items() if name != options.without}
    look_alikes = set(options.look_alikes.split(",")) & set(sets)
    if not look_alikes:
        sys.exit("fit_same_place.py: no set of look-alikes is left; name one with --look-alikes")
    fitted = [*lines("chance_", *fit_chance(sets)),
              *lines("look_alike_", *fit_look_alikes(sets, look_alikes))]
    for key, value in fitted:
        text = f"{value:.4f}".rstrip("0").rstrip(".")
        text = "0" if text in ("-0", "") else text
        print(f"--set same_place.{key}={text}" if options.as_overrides else f"{key} = {text}")


if __name__ == "__main__":
    main()
