#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# KITTI odometry 00 or 05: images to rawlog, loop closures, score.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: kitti_odometry.sh 00|05 DATASET_FOLDER [OUTPUT_FOLDER [GROUND_TRUTH]]
Finds the loop closures of a sequence of the KITTI odometry benchmark and scores them.

Get from https://www.cvlibs.net/datasets/kitti/eval_odometry.php (after registration) and unzip into
one folder:
  data_odometry_gray.zip   the images (22 GB)
  data_odometry_calib.zip  calibration and times
  data_odometry_poses.zip  poses; without them, no score by distance
DATASET_FOLDER is the folder 'dataset' which then holds (for 00):
  sequences/00/image_0/000000.png ...   left, grey: 4541 images (05: 2761), 10 a second
  sequences/00/image_1/000000.png ...   right; without this folder: one camera
  sequences/00/times.txt, calib.txt
  poses/00.txt                          may be missing

The camera and the baseline are those of calib.txt. All frames are used. Configuration:
config-ini/kitti_00.ini, kitti_05.ini. OUTPUT_FOLDER is kitti_00-results, kitti_05-results.
With poses/ it is scored as radius:5 (metres; same view; 30 s old).
$rerun_help

$loop_matrices_help

$environment_help"

help_if_asked "$@"
sequence=${1:-}
case "$sequence" in
  00) whole=4541 ;;
  05) whole=2761 ;;
  *) wrong_usage "name the sequence first: 00 or 05" ;;
esac
shift
read_arguments "kitti_$sequence-results" "$@"
choose_config "kitti_$sequence.ini"

folder=$dataset/sequences/$sequence
poses=$dataset/poses/$sequence.txt
images=$(count_files "$folder/image_0" '*.png')
if [ "$images" -eq 0 ]; then
  miss "$folder/image_0: no PNG images (data_odometry_gray.zip)"
else
  need_frames_of_matrix "$images" "$whole" "images in $folder/image_0"
fi
if [ -d "$folder/image_1" ]; then
  right=$(count_files "$folder/image_1" '*.png')
  [ "$right" -eq "$images" ] || miss "$folder/image_1: $right images for $images in image_0"
fi
for file in times.txt calib.txt; do
  [ -f "$folder/$file" ] || miss "$folder/$file is missing (data_odometry_calib.zip)"
done
if [ -f "$folder/times.txt" ] && [ "$images" -gt 0 ]; then
  times=$(grep -c . "$folder/times.txt" || true)
  [ "$times" -eq "$images" ] || miss "$folder/times.txt: $times times for $images images"
fi
if [ -f "$poses" ] && [ "$images" -gt 0 ]; then
  lines=$(grep -c . "$poses" || true)
  [ "$lines" -eq "$images" ] || miss "$poses: $lines poses for $images images"
fi
stop_if_missing
echo "KITTI odometry $sequence: $images of $whole images$([ -d "$folder/image_1" ] || echo ", left camera only")"

prepare_apps
mkdir -p "$output"
convert "kitti_$sequence" --format kitti --images "$folder"
if [ -f "$poses" ]; then
  find_loops "$poses" radius:5
  score "$poses" radius:5
else
  find_loops
  echo "No $poses: no score by distance."
fi
score_labels
say_where_results_are
