#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a run of rawlog-loop-closure on a drawn town, as a row of a Markdown table.

metric_errors.py NAME RUN_FOLDER TRUTH.tum [GRAPH_AFTER_GRAPH_SLAM]
metric_errors.py --header
"""
import csv
import json
import math
import os
import sys

import numpy as np

HEADER = """| town | loops | edges | median m | median deg | scale % | NEES mean | beyond 99.9 % | ATE before m | ATE after m | after / before | graph-slam / before |
|---|---|---|---|---|---|---|---|---|---|---|---|"""
BEYOND = 22.458  # 99.9 % quantile of chi2 with 6 degrees of freedom


def from_quaternion(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def from_angles(roll, pitch, yaw):
    def turn(axis, angle):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        r = np.eye(3)
        r[i, i] = r[j, j] = math.cos(angle)
        r[j, i] = math.sin(angle)
        r[i, j] = -math.sin(angle)
        return r
    return turn(2, yaw) @ turn(1, pitch) @ turn(0, roll)


def angles_of(r):
    return [math.atan2(r[2, 1], r[2, 2]), -math.asin(max(-1, min(1, r[2, 0]))),
            math.atan2(r[1, 0], r[0, 0])]


def pose(rotation, translation):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = translation
    return matrix


def read_tum(path):
    """Poses by time stamp, in milliseconds."""
    poses = {}
    for line in open(path):
        t, x, y, z, *q = map(float, line.split())
        poses[round(1000 * t)] = pose(from_quaternion(*q), [x, y, z])
    return poses


def ate(estimate, truth):
    """Root mean square distance after the best rigid alignment."""
    keys = sorted(set(estimate) & set(truth))
    a = np.array([estimate[k][:3, 3] for k in keys])
    b = np.array([truth[k][:3, 3] for k in keys])
    a, b = a - a.mean(0), b - b.mean(0)
    u, _, vt = np.linalg.svd(b.T @ a)
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    return math.sqrt((((a @ (u @ flip @ vt).T) - b) ** 2).sum(1).mean())


def read_graph(path):
    """Positions of a .graph file's nodes, and its edges: pose and information by pair of nodes."""
    nodes, edges = {}, {}
    for line in open(path):
        tag, *words = line.split()
        if tag == "VERTEX3":
            nodes[int(words[0])] = pose(np.eye(3), list(map(float, words[1:4])))
        if tag == "VERTEX2" or tag == "VERTEX_SE2":
            nodes[int(words[0])] = pose(np.eye(3), [float(words[1]), float(words[2]), 0])
        if tag == "EDGE3":
            numbers = list(map(float, words[2:]))
            information = np.zeros((6, 6))
            information[np.triu_indices(6)] = numbers[6:27]
            information += np.triu(information, 1).T
            edges[int(words[0]), int(words[1])] = (numbers[:6], information)
    return nodes, edges


def edge_errors(edges, pairs, truth):
    """Metres, degrees, share of the length, and normalised squared error of each loop's edge."""
    rows = []
    for a, b in pairs:
        if (a, b) not in edges:
            continue
        measured, information = edges[a, b]
        delta = np.linalg.inv(truth[a]) @ truth[b]
        error = np.concatenate([delta[:3, 3] - measured[:3],
                                np.array(angles_of(delta[:3, :3])) - measured[3:]])
        error[3:] = (error[3:] + math.pi) % (2 * math.pi) - math.pi
        turned = from_angles(*measured[3:]).T @ delta[:3, :3]
        degrees = math.degrees(math.acos(max(-1, min(1, (np.trace(turned) - 1) / 2))))
        length = np.linalg.norm(delta[:3, 3])
        scale = abs(np.linalg.norm(measured[:3]) / length - 1) if length > 0.5 else math.nan
        rows.append([np.linalg.norm(error[:3]), degrees, scale, error @ information @ error])
    return np.array(rows) if rows else np.full((1, 4), math.nan)


def main():
    if sys.argv[1:] == ["--header"]:
        print(HEADER)
        return
    name, run, truth_path, *after = sys.argv[1:]
    truth = read_tum(truth_path)
    by_frame = [truth[key] for key in sorted(truth)]
    loops = list(csv.DictReader(open(os.path.join(run, "loops.csv"))))
    pairs = [(int(row["candidate"]), int(row["frame"])) for row in loops if row["edge"] == "used"]
    graph = os.path.join(run, "poses.graph")
    errors = edge_errors(read_graph(graph)[1], pairs, by_frame) if os.path.exists(graph) else (
        np.full((1, 4), math.nan))
    # A 2D graph has no edges in space to compare.
    medians = errors[0] if np.isnan(errors).all() else np.nanmedian(errors, 0)
    before = after_ours = left = math.nan
    tum = os.path.join(run, "trajectory_input.tum")
    if os.path.exists(tum):
        before = ate(read_tum(tum), truth)
        after_ours = ate(read_tum(tum.replace("input", "optimized")), truth)
    if after:
        nodes, _ = read_graph(after[0])
        left = ate(nodes, dict(enumerate(by_frame))) / before
    parts = json.load(open(os.path.join(run, "summary.json")))["map"]["parts"]
    print(f"| {name} | {len(loops)} | {len(pairs)} | {medians[0]:.4f} | {medians[1]:.3f} "
          f"| {100 * medians[2]:.2f} | {errors[:, 3].mean():.2f} "
          f"| {100 * (errors[:, 3] > BEYOND).mean():.1f} % | {before:.2f} | {after_ours:.2f} "
          f"| {after_ours / before:.2f} | {left:.2f} |"
          + (f" in {len(parts)} parts" if len(parts) > 1 else ""))


if __name__ == "__main__":
    main()
