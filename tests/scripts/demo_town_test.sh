#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# demo.sh without an argument, with the installed model: what it promises of the town. Exit code 77: the
# model is not there, nothing was tested.
set -euo pipefail

if [ $# -ne 3 ]; then
  echo "Usage: demo_town_test.sh SOURCE_DIR APPS_DIR PYTHON" >&2
  exit 2
fi
source_dir=$1 python=$3
FILD_APPS=$(realpath "$2")
export FILD_APPS
model=${XDG_DATA_HOME:-$HOME/.local/share}/mrpt-fild/mobilenet_v2_objectron.onnx
[ -e "$model" ] || { echo "$model is missing"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$work"
"$source_dir/datasets-scripts/demo.sh"
"$python" - << 'END'
import csv, json, sys

score = json.load(open("demo-results/evaluation/window_10/evaluation.json"))
assert score["precision"] == 1, score["precision"]
assert score["recall"] >= 0.7, score["recall"]

# Whatever was accepted is near: no look-alike house, no place seen in the opposite direction.
places = [list(map(float, line.split()[1:4])) for line in open("demo-results/town.gt.tum")]
for loop in csv.DictReader(open("demo-results/loops.csv")):
    query, candidate = places[int(loop["frame"])], places[int(loop["candidate"])]
    metres = sum((a - b) ** 2 for a, b in zip(query, candidate)) ** 0.5
    assert metres < 40, (loop, metres)
END
