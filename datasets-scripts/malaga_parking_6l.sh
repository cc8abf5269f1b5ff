#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Malaga 2009 Parking 6L: its own rawlog or its images, loop closures, score.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: malaga_parking_6l.sh DATASET_FOLDER [OUTPUT_FOLDER [GROUND_TRUTH]]
Finds the loop closures of PARKING-6L, of the Malaga 2009 data sets, and scores them.

Get PARKING-6L from https://www.mrpt.org/malaga_dataset_2009: the rawlog, with its images beside it,
or the images alone. DATASET_FOLDER holds either
  NAME.rawlog or NAME.rawlog.gz, and NAME_Images/   read as it is, both cameras as a stereo pair, with the
                                                    rawlog's own calibration and poses
or
  CAMERA_LEFT_1226322035.529528.jpg ...             3474 images of 1024x768 as they were recorded, not
                                                    the rectified ones; 7.5 a second, by their names
  CAMERA_RIGHT_1226322035.533012.jpg ...            the right camera's, which need
  calibration.txt                                   both cameras and the right one's pose, in the form of
                                                    images-to-rawlog

Without calibration.txt, images become a rawlog of the left camera alone, with the published calibration,
which has no pose of the right camera. All frames are used. Configuration: config-ini/malaga_parking_6l.ini. OUTPUT_FOLDER is malaga_parking_6l-results.
$rerun_help

$loop_matrices_help

$environment_help"

help_if_asked "$@"
read_arguments malaga_parking_6l-results "$@"
choose_config malaga_parking_6l.ini

shopt -s nullglob
rawlogs=("$dataset"/*.rawlog "$dataset"/*.rawlog.gz)
shopt -u nullglob
images=$(count_files "$dataset" 'CAMERA_LEFT_*.jpg')
right_images=$(count_files "$dataset" 'CAMERA_RIGHT_*.jpg')
if [ ${#rawlogs[@]} -gt 1 ]; then
  miss "$dataset holds ${#rawlogs[@]} rawlogs; leave one: ${rawlogs[*]##*/}"
elif [ ${#rawlogs[@]} -eq 0 ] && [ "$images" -eq 0 ]; then
  miss "$dataset holds neither a .rawlog nor CAMERA_LEFT_SECONDS.jpg images"
elif [ ${#rawlogs[@]} -eq 0 ]; then
  need_frames_of_matrix "$images" 3474 "CAMERA_LEFT images in $dataset"
fi
stop_if_missing

prepare_apps
mkdir -p "$output"
if [ ${#rawlogs[@]} -eq 1 ]; then
  rawlog=${rawlogs[0]}
  # Named, because the one that goes with NAME.rawlog.gz would be NAME.rawlog_Images.
  name=$(basename "${rawlog%.gz}" .rawlog)
  [ ! -d "$dataset/${name}_Images" ] || images_dir=$dataset/${name}_Images
  echo "Malaga 2009 Parking 6L: ${rawlog##*/} as it is"
elif [ -f "$dataset/calibration.txt" ]; then
  echo "Malaga 2009 Parking 6L: $images of 3474 images, $right_images of the right camera"
  convert malaga_parking_6l --format malaga --images "$dataset" --calib "$dataset/calibration.txt"
else
  echo "Malaga 2009 Parking 6L: $images of 3474 images"
  [ "$right_images" -eq 0 ] ||
    echo "$self: $right_images right images are left out: their camera's pose is in no calibration.txt" >&2
  # Checked on an image: near the border a pillar of 200 pixels is bent by 2.2, with this by 0.2.
  write_calibration \
    "CAMERA_LEFT of Malaga 2009: Blanco, Moreno and Gonzalez, Autonomous Robots 27(4), 2009" \
    "923.5295 922.2418 507.2222 383.5822 1024 768 -0.353754 0.162014 0.001643379 0.0003655471"
  find -L "$dataset" -maxdepth 1 -type f -name 'CAMERA_LEFT_*.jpg' | sort |
    sed -E 's|^(.*/CAMERA_LEFT_([0-9.]+)\.jpg)$|\1 \2|' > "$output/frames.txt"
  convert malaga_parking_6l --list "$output/frames.txt" --calib "$calibration" \
    --sensor-label CAMERA_LEFT
fi
find_loops
score_labels
say_where_results_are
