#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws two laps along a wall, laid out and named as a public data set is.

Usage: draw_data_sets.py kitti|malaga|newcollege|tum FOLDER FRAMES_PER_LAP
Frame FRAMES_PER_LAP + i shows what frame i shows; FOLDER.loops.txt says so, from frame to frame.
"""
import importlib.util
import pathlib
import sys

import cv2
import numpy

STEP_SECONDS = 5  # so that a lap is older than the 30 seconds of protocol radius

sys.dont_write_bytecode = True
_path = pathlib.Path(__file__).resolve().parents[1] / "consumer/draw_two_laps.py"
_spec = importlib.util.spec_from_file_location("draw_two_laps", _path)
wall_drawing = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(wall_drawing)


def views(frames, width, height):
    step = wall_drawing.STEP * width // wall_drawing.WIDTH
    wall = wall_drawing.draw_wall(step * frames + width + 40, height + 20, numpy.random.default_rng(1))
    for number in range(2 * frames):
        lap, i = divmod(number, frames)
        x, y = step * i + 7 * lap, 4 * lap
        yield wall[y : y + height, x : x + width]


def write(path, image):
    path.parent.mkdir(parents=True, exist_ok=True)
    if not cv2.imwrite(str(path), image):
        raise OSError(f"cannot write {path}")


def metres(number, frames):
    return 10.0 * (number % frames)


def kitti(folder, frames):
    sequence = folder / "sequences/00"
    for number, view in enumerate(views(frames, 620, 188)):
        write(sequence / f"image_0/{number:06}.png", view)
        write(sequence / f"image_1/{number:06}.png", view)
    (sequence / "times.txt").write_text("".join(f"{STEP_SECONDS * i:e}\n" for i in range(2 * frames)))
    projection = "350 0 310 {} 0 350 94 0 0 0 1 0"
    rows = [f"P{i}: {projection.format(offset)}\n" for i, offset in enumerate((0, -189, 20, -160))]
    (sequence / "calib.txt").write_text("".join(rows))
    (folder / "poses").mkdir()
    poses = (f"1 0 0 0 0 1 0 0 0 0 1 {metres(i, frames)}\n" for i in range(2 * frames))
    (folder / "poses/00.txt").write_text("".join(poses))


def malaga(folder, frames):
    for number, view in enumerate(views(frames, 1024, 768)):
        write(folder / f"CAMERA_LEFT_{1226322035 + STEP_SECONDS * number}.529528.jpg", view)


def newcollege(folder, frames):
    """20 images a second, of which the first of each 20 differs from those before it."""
    stamp_20ths = 0
    for view in views(frames, 512, 384):
        for _ in range(20):
            seconds = f"{1225719815 + stamp_20ths // 20}.{stamp_20ths % 20 * 5:02}4878"
            archive = folder / ("StereoImages_1" if stamp_20ths < 100 else "StereoImages_2")
            write(archive / f"StereoImage__{seconds}-left.pnm", view)
            write(archive / f"StereoImage__{seconds}-right.pnm", view)
            stamp_20ths += 1


def tum(folder, frames):
    names = {"rgb": [], "depth": []}
    poses = []
    for number, view in enumerate(views(frames, 640, 480)):
        seconds = 1341847980 + STEP_SECONDS * number
        for kind, image, offset in (("rgb", cv2.merge([view] * 3), 0.72), ("depth", view.astype(numpy.uint16) * 40, 0.73)):
            name = f"{kind}/{seconds + offset:.6f}.png"
            write(folder / name, image)
            names[kind].append(f"{seconds + offset:.6f} {name}\n")
        poses.append(f"{seconds + 0.725:.4f} {metres(number, frames)} 0 1 0 0 0 1\n")
    for kind, lines in names.items():
        (folder / f"{kind}.txt").write_text("# timestamp filename\n" + "".join(lines))
    (folder / "groundtruth.txt").write_text("# timestamp tx ty tz qx qy qz qw\n" + "".join(poses))


def main():
    kind, folder, frames = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    {"kitti": kitti, "malaga": malaga, "newcollege": newcollege, "tum": tum}[kind](folder, frames)
    loops = "".join(f"{frames + i} {i}\n" for i in range(frames))
    folder.with_name(folder.name + ".loops.txt").write_text(loops)


if __name__ == "__main__":
    main()
