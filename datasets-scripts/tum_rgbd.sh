#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A sequence of the TUM RGB-D benchmark: images to rawlog, loop closures, score.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: tum_rgbd.sh DATASET_FOLDER [OUTPUT_FOLDER]
Finds the loop closures of a sequence of the TUM RGB-D benchmark and scores them by its poses.

Get a sequence from https://cvg.cit.tum.de/data/datasets/rgbd-dataset/download and unpack it, such as
freiburg3_long_office_household. DATASET_FOLDER holds
  rgb.txt, rgb/SECONDS.png ...       colour, 640x480, 30 a second
  depth.txt, depth/SECONDS.png ...   depth, 5000 units a metre
  groundtruth.txt                    may be missing: then no score

The camera is that of freiburg1, 2 or 3, by the folder's name; TUM_CAMERA=1, 2 or 3 says so for another
name. All frames are used. Configuration: config-ini/default.ini, whose delay is 20 s: a shorter sequence
has no loops. OUTPUT_FOLDER is tum_rgbd-results. Scored as radius:0.5 (metres) with poses turned
by at most 30 degrees and candidates at least as old as the delay.
$rerun_help

$environment_help"

help_if_asked "$@"
[ $# -le 2 ] || wrong_usage "too many arguments: '$3'"
read_arguments tum_rgbd-results "$@"
choose_config default.ini

camera=${TUM_CAMERA:-}
if [ -z "$camera" ] && [[ ${dataset##*/} =~ (freiburg|fr)([123]) ]]; then camera=${BASH_REMATCH[2]}; fi
# fx fy cx cy, the size, k1 k2 p1 p2 k3; images of freiburg3 are published undistorted.
case "$camera" in
  1) intrinsics="517.3 516.5 318.6 255.3 640 480 0.2624 -0.9531 -0.0054 0.0026 1.1633" ;;
  2) intrinsics="520.9 521.0 325.1 249.7 640 480 0.2312 -0.7849 -0.0033 -0.0001 0.9172" ;;
  3) intrinsics="535.4 539.2 320.1 247.6 640 480" ;;
  *) miss "which camera? ${dataset##*/} has no freiburg1, 2 or 3 in its name; set TUM_CAMERA=1, 2 or 3" ;;
esac
for kind in rgb depth; do
  if [ ! -f "$dataset/$kind.txt" ]; then
    miss "$dataset/$kind.txt is missing"
    continue
  fi
  listed=$(grep -c '^[^#]' "$dataset/$kind.txt" || true)
  present=$(count_files "$dataset/$kind" '*.png')
  [ "$listed" -gt 0 ] || miss "$dataset/$kind.txt lists no images"
  [ "$present" -ge "$listed" ] || miss "$dataset/$kind: $present images, $kind.txt lists $listed"
done
stop_if_missing
echo "TUM RGB-D ${dataset##*/}: $(grep -c '^[^#]' "$dataset/rgb.txt") images, camera of freiburg$camera"

prepare_apps
mkdir -p "$output"
write_calibration \
  "freiburg$camera, colour camera: https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats" \
  "$intrinsics"
convert tum_rgbd --format tum --images "$dataset" --calib "$calibration"
if [ -f "$output/tum_rgbd.gt.tum" ]; then
  find_loops "$output/tum_rgbd.gt.tum" radius:0.5
  score "$output/tum_rgbd.gt.tum" radius:0.5 --max-angle 30
else
  find_loops
  echo "No groundtruth.txt: no score."
fi
say_where_results_are
