#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills rawlog-loop-closure with SIGKILL at random moments and at its renames, and looks at what is
left: no file under its final name is torn, the verdicts up to the last second are on disk, and the
next run into the same folder gives what an undisturbed run gives.

Usage: kill_run.py APPS NETWORK PRELOAD [--moments N] [--renames N] [--seed N]
APPS is the folder of the apps, NETWORK that of make_tiny_network.py, PRELOAD the library of
kill_at_rename.cpp. --renames 0 takes each of them. Exit 1 when something is torn or missing.
"""
import argparse
import csv
import gzip
import io
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

UNFINISHED = ".fild-part-"
# What the same input gives the same bytes of.
REPEATABLE = ["frames.csv", "loops.csv", "candidates.csv", "poses.csv", "poses.graph", "poses.g2o",
              "trajectory_input.tum", "trajectory_optimized.tum"]
CONFIG = """[global_descriptor]
model_file = {network}
layers = map
input_width = 4
input_height = 4
[index]
delay_seconds = 5
[consistency]
consecutive_frames = 1
"""


class Progress:
    """The frames that a running app says it has done, and when it said so."""

    def __init__(self, stream):
        self.reports = []
        self.thread = threading.Thread(target=self.read, args=(stream,))
        self.thread.start()

    def read(self, stream):
        for line in stream:
            if found := re.search(rb"frame (\d+) ", line):
                self.reports.append((time.monotonic(), int(found[1])))

    def frames_before(self, moment):
        self.thread.join()
        return max((frames for at, frames in self.reports if at <= moment), default=0)


class Harness:
    def __init__(self, arguments, folder):
        self.app = f"{arguments.apps}/rawlog-loop-closure/rawlog-loop-closure"
        self.preload = arguments.preload
        self.folder = folder
        self.output = folder / "out"
        self.faults = []
        subprocess.run([f"{arguments.apps}/synthetic-rawlog/synthetic-rawlog", "--preset", "tiny",
                        "--frames", "40", "--output", folder / "town.rawlog", "--quiet"],
                       check=True, stdout=subprocess.DEVNULL)
        (folder / "run.ini").write_text(CONFIG.format(network=arguments.network))
        self.seconds = 0.0
        self.reference = self.undisturbed()

    def command(self):
        return [self.app, "--rawlog", self.folder / "town.rawlog", "--config",
                self.folder / "run.ini", "--output", self.output]

    def undisturbed(self):
        """Runs to the end. Returns the bytes of the files that repeat."""
        start = time.monotonic()
        subprocess.run(self.command(), check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        self.seconds = time.monotonic() - start
        return {name: (self.output / name).read_bytes() for name in REPEATABLE}

    def kill(self, name, after=None, environment=None):
        """Runs and kills; then checks what is left, and that the next run is not disturbed."""
        start = time.monotonic()
        process = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, env={**os.environ, **(environment or {})})
        progress = Progress(process.stderr)
        try:
            process.wait(timeout=after)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        killed = time.monotonic()
        status = process.wait()
        if status not in (0, -signal.SIGKILL):
            self.faults.append(f"{name}: exit status {status}")
        before = len(self.faults)
        if status != 0:
            self.check_verdicts(name, progress.frames_before(killed - 1))
        self.check_files(name)
        print(f"{name}: {'killed' if status else 'had ended'} after {killed - start:.1f} s, "
              f"{'good' if len(self.faults) == before else 'BAD'}", flush=True)
        return status != 0

    def check_verdicts(self, name, frames):
        rows = [self.rows_of(path) for path in self.output.glob(f"frames.csv{UNFINISHED}*")]
        whole = self.output / "frames.csv"
        if whole.exists():
            rows.append(self.rows_of(whole))
        if max(rows, default=0) < frames:
            self.faults.append(f"{name}: {rows} verdicts on disk, {frames} frames done")

    @staticmethod
    def rows_of(path):
        return max(0, path.read_bytes().count(b"\n") - 1)

    def check_files(self, name):
        for path in sorted(self.output.rglob("*")):
            if path.is_dir() or UNFINISHED in path.name or path.name == ".lock":
                continue
            if fault := self.fault_of(path):
                self.faults.append(f"{name}: {path.relative_to(self.output)} {fault}")

    def fault_of(self, path):
        """What is wrong with a file that has its final name; None: nothing."""
        content = path.read_bytes()
        expected = self.reference.get(path.name)
        if expected is not None and path.parent == self.output:
            is_earlier = path.name in ("frames.csv", "loops.csv")  # written again with the map
            if content == expected:
                return None
            if not is_earlier:
                return "is not what an undisturbed run writes"
        endings = {".png": b"IEND\xaeB`\x82", ".jpg": b"\xff\xd9", ".html": b"</html>\n",
                   ".csv": b"\n"}
        if not content.endswith(endings.get(path.suffix, b"")):
            return "is torn"
        try:
            if path.suffix == ".json":
                json.loads(content)
                missing = [each for each in self.reference if not (self.output / each).exists()]
                return f"is there without {missing}" if missing else None
            if path.suffix in (".simplemap", ".3Dscene"):
                gzip.decompress(content)
            if path.suffix == ".csv":
                rows = list(csv.reader(io.StringIO(content.decode())))
                return None if {len(row) for row in rows} == {len(rows[0])} else "has torn rows"
        except (ValueError, OSError, EOFError) as error:
            return f"is torn: {error}"
        return None

    def check_next_run(self):
        if self.undisturbed() != self.first_reference:
            self.faults.append("the run after a kill gives other results")
        if left := [path.name for path in self.output.rglob(f"*{UNFINISHED}*")]:
            self.faults.append(f"the run after a kill leaves {left}")

    def at_moments(self, count, seed):
        random.seed(seed)
        killed = 0
        for i in range(count):
            after = random.uniform(0, self.seconds)
            killed += self.kill(f"moment {i + 1}", after=after)
            if i % 10 == 0:
                self.check_next_run()
        return killed

    def renames_of_a_run(self):
        """Renames until a run is not killed any more."""
        count = 1
        while self.kill(f"after rename {count}", environment=self.at_rename("AFTER", count)):
            count *= 2
        low, high = count // 2, count
        while high - low > 1:
            middle = (low + high) // 2
            killed = self.kill(f"after rename {middle}",
                               environment=self.at_rename("AFTER", middle))
            low, high = (middle, high) if killed else (low, middle)
        return low

    def at_rename(self, when, number):
        return {"LD_PRELOAD": self.preload, f"KILL_{when}_RENAME": str(number)}

    def at_renames(self, limit):
        if limit == 0:
            limit = self.renames_of_a_run()
        killed = 0
        for number in range(1, limit + 1):
            when = "BEFORE" if number % 2 else "AFTER"
            killed += self.kill(f"{when.lower()} rename {number}",
                                environment=self.at_rename(when, number))
        self.check_next_run()
        return killed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("apps")
    parser.add_argument("network")
    parser.add_argument("preload")
    parser.add_argument("--moments", type=int, default=100)
    parser.add_argument("--renames", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        harness = Harness(arguments, pathlib.Path(folder))
        harness.first_reference = harness.reference
        killed = harness.at_moments(arguments.moments, arguments.seed)
        killed_at_renames = harness.at_renames(arguments.renames)
    if killed == 0 or killed_at_renames == 0:
        harness.faults.append("no run was killed: they end too early")
    print(f"{killed} killed at moments, {killed_at_renames} at renames, "
          f"{len(harness.faults)} faults")
    for fault in harness.faults:
        print(f"  {fault}", file=sys.stderr)
    return 1 if harness.faults else 0


if __name__ == "__main__":
    sys.exit(main())
