#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# demo.sh without an argument, with the installed model: what it promises of the town, or with
# FILD_FULL_TESTS unset of a smaller one. Exit code 77: the model is not there, nothing was tested.
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
if [ -n "${FILD_FULL_TESTS:-}" ]; then
  export DEMO_PRESET=demo recall=0.9 segment_recall=1
else
  export DEMO_PRESET=tiny recall=0.8 segment_recall=0.5
fi
"$source_dir/datasets-scripts/demo.sh"
"$python" - << 'END'
import csv, json, math, os

least_recall, least_segment_recall = (float(os.environ[name]) for name in ("recall", "segment_recall"))
score = json.load(open("demo-results/evaluation/window_10/evaluation.json"))
assert score["precision"] == 1, score["precision"]
assert score["recall"] >= least_recall and score["segment_recall"] >= least_segment_recall, score
exact = json.load(open("demo-results/evaluation/exact/evaluation.json"))
assert exact["precision"] == 1 and exact["recall"] >= least_recall, exact

# Whatever was accepted shows the same houses, as the truth says of it (a line `query candidate 0`: from
# further off): no look-alike. Nearly all of it is near and seen in the same direction.
def heading(qx, qy, qz, qw):
    return math.degrees(math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz)))

same_houses = {tuple(line.split()[:2]) for line in open("demo-results/town.loops.txt") if line[0] != "#"}
poses = [list(map(float, line.split()[1:])) for line in open("demo-results/town.gt.tum")]
near = 0
loops = list(csv.DictReader(open("demo-results/loops.csv")))
for loop in loops:
    assert (loop["frame"], loop["candidate"]) in same_houses, loop
    query, candidate = poses[int(loop["frame"])], poses[int(loop["candidate"])]
    turned = abs((heading(*query[3:]) - heading(*candidate[3:]) + 180) % 360 - 180)
    assert turned < 60, (loop, turned)
    near += math.dist(query[:3], candidate[:3]) < 10
assert near >= 0.85 * len(loops), (near, len(loops))
END
