#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what a camera sees that drives along a wall of bars twice, as FOLDER/00.pgm, 01.pgm, ...

Usage: draw_two_laps.py FOLDER FRAMES_PER_LAP
Frame FRAMES_PER_LAP + i shows what frame i shows, from a little further to the side.
"""
import pathlib
import sys

import numpy

WIDTH, HEIGHT, STEP = 320, 240, 80


def draw_wall(width, height, random):
    wall = numpy.full((height, width), 128, dtype=numpy.uint8)
    for _ in range(width * height // 400):
        x, y = random.integers(width), random.integers(height)
        w, h = random.integers(4, 20), random.integers(3, 12)
        wall[y : y + h, x : x + w] = random.integers(256)
    return wall


def main():
    folder, frames = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    wall = draw_wall(STEP * frames + WIDTH + 40, HEIGHT + 20, numpy.random.default_rng(1))
    for number in range(2 * frames):
        lap, i = divmod(number, frames)
        x, y = STEP * i + 7 * lap, 4 * lap
        view = wall[y : y + HEIGHT, x : x + WIDTH]
        header = f"P5 {WIDTH} {HEIGHT} 255\n".encode()
        (folder / f"{number:02}.pgm").write_bytes(header + view.tobytes())


if __name__ == "__main__":
    main()
