# SPDX-License-Identifier: BSD-3-Clause
"""Writes folders as rawlog-loop-closure leaves them, of drives that were never driven: a circle,
twice around. What they hold is the ground for tests of the pages that are made of them."""

import json
import math
import os

import cv2
import numpy as np

FRAME_COLUMNS = ("frame,timestamp,sensor_label,keypoints,candidate,similarity,matches,inliers,accepted,"
                 "rejection,support,depth_source")
EDGE_COLUMNS = ("x,y,z,yaw_deg,pitch_deg,roll_deg,sigma_x,sigma_y,sigma_z,sigma_yaw_deg,sigma_pitch_deg,"
                "sigma_roll_deg,weight,edge")
STAGES = {"image_decoding": 4, "global_descriptor": 40, "local_features": 60, "hashing": 2, "index_search": 1,
          "matching": 6, "verification": 5}


class Drive:
    """Twice around a circle of 50 m, `frames` frames at 2 Hz. The first `wrong` loop closures are wrong;
    `probability`: accepted by [same_place], and rejected with many inliers."""

    def __init__(self, frames, loops=True, edges=True, trajectory=True, seed=1, wrong=0, probability=False):
        self.frames = frames
        self.lap = max(1, frames // 2)
        self.loops = loops
        self.edges = edges and trajectory
        self.trajectory = trajectory
        self.wrong = wrong
        self.probability = probability
        self.random = np.random.default_rng(seed)

    def time(self, frame):
        return 1000 + 0.5 * frame

    def candidate(self, frame):
        if frame < self.lap or frame == 0:
            return None
        place = frame - self.lap
        is_wrong = self.wrong > 0 and self.is_accepted(frame) and sum(self.is_accepted(i) for i in range(self.lap, frame)) < self.wrong
        return (place + self.lap // 3) % self.lap if is_wrong else place

    def is_accepted(self, frame):
        return self.loops and frame >= self.lap and frame > 0 and frame % 5 != 0

    def accepted(self):
        return [frame for frame in range(self.frames) if self.is_accepted(frame)]

    def rejected(self):
        return [frame for frame in range(self.frames)
                if self.candidate(frame) is not None and not self.is_accepted(frame)]

    def place(self, frame, drift):
        """Position, and heading in radians, after `drift` metres of sideways drift a lap."""
        angle = 2 * math.pi * frame / self.lap
        aside = drift * frame / self.lap
        return 50 * math.cos(angle) + aside, 50 * math.sin(angle), angle + math.pi / 2


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def frame_row(drive, frame):
    candidate = drive.candidate(frame)
    accepted = drive.is_accepted(frame)
    inliers = 0 if candidate is None else int(drive.random.integers(20, 150) if accepted else drive.random.integers(0, 12))
    support = inliers / 20 if accepted else inliers / 13
    reason = "too_few_inliers"
    if drive.probability and candidate is not None:
        inliers = int(drive.random.integers(13, 150))
        support = drive.random.uniform(0.951, 1) if accepted else drive.random.uniform(0, 0.9499)
        reason = "may_be_look_alike"
    rejection = "" if accepted else "too_early" if candidate is None else reason
    pair = (f"{candidate},{0.6 + 0.3 * drive.random.random():.6f}" if candidate is not None else ",")
    return (f"{frame},{drive.time(frame):.6f},LEFT,{int(drive.random.integers(300, 1500))},{pair},"
            f"{2 * inliers},{inliers},{int(accepted)},{rejection},{support:.6f},none")


def write_tables(drive, folder):
    rows = [frame_row(drive, frame) for frame in range(drive.frames)]
    write(folder, "frames.csv", "\n".join([FRAME_COLUMNS, *rows]) + "\n")
    edge = "0.05,0.02,0,0.4,0,0,0.02,0.03,0.01,0.1,0.1,0.1,1.000000,used" if drive.edges else "," * 13 + "not_calibrated"
    write(folder, "loops.csv",
          "\n".join([f"{FRAME_COLUMNS},{EDGE_COLUMNS}", *(f"{rows[i]},{edge}" for i in drive.accepted())]) + "\n")
    header = ",".join(["frame", *(f"{stage}_ms" for stage in STAGES), "whole_frame_ms", "map_bytes", "resident_bytes"])
    costs = []
    for frame in range(drive.frames):
        times = [mean * (0.8 + 0.4 * drive.random.random()) for mean in STAGES.values()]
        costs.append(",".join([str(frame), *(f"{t:.3f}" for t in times), f"{sum(times):.3f}", str(40000 * frame),
                               str(150000000 + 45000 * frame)]))
    write(folder, "costs.csv", "\n".join([header, *costs]) + "\n")


def write_trajectory(drive, folder, name, drift):
    lines = []
    for frame in range(drive.frames):
        x, y, yaw = drive.place(frame, drift)
        lines.append(f"{drive.time(frame):.6f} {x:.6f} {y:.6f} 0 0 0 {math.sin(yaw / 2):.9f} {math.cos(yaw / 2):.9f}\n")
    write(folder, name, "".join(lines))


def summary_of(drive, options):
    loops = len(drive.accepted())
    times = {stage: {"calls": drive.frames, "mean": mean, "median": mean, "p95": 1.3 * mean, "max": 2 * mean,
                     "total": mean * drive.frames} for stage, mean in [*STAGES.items(), ("whole_frame", 118)]}
    return {
        "command": "rawlog-loop-closure --rawlog drive.rawlog --config default.ini --output out",
        "rawlog": "/data/drive.rawlog", "max_frames": 0, "complete": True, "ended_early": "",
        "frames": {"camera_frames": drive.frames, "loop_closures": loops, "frames_per_similarity_row": frames_per_row(drive)},
        "map": {"trajectory": "recorded" if drive.trajectory else "none", "trajectory_source": "", "nodes":
                drive.frames if drive.trajectory else 0, "odometry_edges": max(0, drive.frames - 1), "loop_edges":
                loops if drive.edges else 0, "loops_without_weight": {}, "loops_withheld":
                {} if drive.edges or not loops else {"not_calibrated": loops}, "chi2_before": 900.5, "chi2_after": 31.25,
                "parts": [drive.frames], "optimizations": 2, "frames_without_pose": 0, "resets": 0, "gaps": 0,
                "clock_jumps": 0, "unusable_readings": 0, "depth_sources": {"none": drive.frames}, "depth_defects": {},
                "notes": [] if drive.trajectory else ["no map: the recording has no odometry, and its images no depth"]},
        "options": {"index": {"min_similarity": "-1", "backend": "hnsw"}, "verification": {"min_inliers": "12"},
                    "same_place": {"enabled": "true" if drive.probability else "false", "min_probability": "0.95"},
                    "runtime": {"seed": "1"}, **options},
        "versions": {"mrpt-fild": "0.1.0", "MRPT": "2.5.8"}, "model": {"file": "model.onnx", "sha256": "0" * 64},
        "stage_times_ms": times, "wall_seconds": 0.12 * drive.frames,
        "memory": {"peak_bytes": 400000000, "map_bytes": 40000 * drive.frames, "map_bytes_per_frame": 40000},
    }


def frames_per_row(drive):
    step = 1
    while drive.frames > 500 * step:
        step *= 2
    return step


def write_similarities(drive, folder):
    step = frames_per_row(drive)
    side = -(-drive.frames // step)
    row, column = np.mgrid[0:side, 0:side]
    apart = np.abs((row - column) * step % drive.lap)
    near = np.exp(-np.minimum(apart, drive.lap - apart) / (0.02 * drive.lap))
    picture = np.clip(255 * near + drive.random.integers(0, 60, (side, side)), 0, 255)
    cv2.imwrite(os.path.join(folder, "similarity.png"), np.where(column < row, picture, 0).astype(np.uint8))


def photograph(random, width, height):
    """Detail of several sizes, as much as a street has."""
    picture = np.zeros((height, width, 3), np.float32)
    for cells, strength in ((8, 90), (40, 60), (160, 40)):
        coarse = random.normal(0, strength, (max(2, cells * height // width), cells, 3)).astype(np.float32)
        picture += cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC)
    return np.clip(128 + picture, 0, 255).astype(np.uint8)


def map_picture(drive):
    """The circle on an empty ground, 8 pixels a metre."""
    picture = np.full((1000, 1600, 3), 90, np.uint8)
    track = [[round(800 + 8 * x), round(500 - 8 * y)] for x, y, _ in (drive.place(i, 0) for i in range(drive.frames))]
    return cv2.polylines(picture, [np.array(track)], False, (60, 160, 240), 3)


def write_pictures(drive, folder, accepted, rejected):
    """Of the first pairs; every second one has a picture in 3D too."""
    os.makedirs(os.path.join(folder, "matches"))
    chosen = [drive.accepted()[:accepted], drive.rejected()[:rejected]]
    for i, frame in enumerate(frame for frames in chosen for frame in frames):
        name = os.path.join(folder, "matches", f"{frame}_{drive.candidate(frame)}")
        cv2.imwrite(name + ".jpg", photograph(drive.random, 1280, 430))
        if i % 2 == 0:
            cv2.imwrite(name + "_3d.jpg", photograph(drive.random, 1000, 625))
    if drive.trajectory:
        for name in ("map_top.png", "map_perspective.png"):
            cv2.imwrite(os.path.join(folder, name), map_picture(drive))


def write_run(drive, folder, options=None, accepted_pictures=12, rejected_pictures=4):
    """Everything; `options` are sections beside the usual ones. Each picture slows the browser down."""
    os.makedirs(folder)
    write_tables(drive, folder)
    write_similarities(drive, folder)
    write_pictures(drive, folder, accepted_pictures, rejected_pictures)
    if drive.trajectory:
        write_trajectory(drive, folder, "trajectory_input.tum", 4)
        write_trajectory(drive, folder, "trajectory_optimized.tum", 0.1)
        write_trajectory(drive, folder, "truth.tum", 0)
    write(folder, "summary.json", json.dumps(summary_of(drive, options or {})))
