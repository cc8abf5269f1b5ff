#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# New College Vision and Laser Data Set: images to rawlog, loop closures, score.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: new_college.sh DATASET_FOLDER [OUTPUT_FOLDER [GROUND_TRUTH]]
Finds the loop closures of the New College Vision and Laser Data Set and scores them.

Get the archives StereoImages_FROM_to_TO.tgz of the full data set from
http://www.robots.ox.ac.uk/NewCollegeData/ (Downloads) and unpack all. DATASET_FOLDER holds, in itself
or in its sub-folders,
  StereoImage__1225719815.864878-left.pnm ...    52480 images of 512x384, 20 a second
  StereoImage__1225719815.864878-right.pnm ...   may be missing: then one camera

Published results use every 20th image from the first on, 2624, about one a second, and so does this.
Images that are a second apart already are all used. The camera and the baseline are those
of the rectified pair. Configuration: config-ini/new_college.ini. OUTPUT_FOLDER is new_college-results.
$rerun_help

$loop_matrices_help

$environment_help"

help_if_asked "$@"
read_arguments new_college-results "$@"
choose_config new_college.ini

# left_images: SECONDS PATH of each left image, in the order of time.
left_images() {
  find -L "$dataset" -maxdepth 3 -name '*_Images' -prune -o \
    -type f -name 'StereoImage__*-left.pnm' -print |
    sed -E 's|^(.*/StereoImage__([0-9.]+)-left\.pnm)$|\2 \1|' | sort -k 1,1n
}

# every_20th_of_video: passes every 20th line when the lines are less than half a second apart (median),
# else all.
every_20th_of_video() {
  local lines step
  lines=$(cat)
  step=$(awk 'NR > 1 { print $1 - before } { before = $1 }' <<< "$lines" | sort -g |
    awk '{ steps[NR] = $1 } END { print steps[int((NR + 1) / 2)] }')
  awk -v every="$(awk -v step="$step" 'BEGIN { print step < 0.5 ? 20 : 1 }')" \
    'NR % every == 1 % every' <<< "$lines"
}

found=$(left_images)
count=0
if [ -z "$found" ]; then
  miss "$dataset: no StereoImage__SECONDS-left.pnm in it or its sub-folders"
else
  count=$(wc -l <<< "$found")
  chosen=$(every_20th_of_video <<< "$found")
  frames=$(wc -l <<< "$chosen")
  need_frames_of_matrix "$frames" 2624 "images chosen out of $count in $dataset"
  without_right=0
  while read -r _ left; do
    [ -f "${left%-left.pnm}-right.pnm" ] || without_right=$((without_right + 1))
  done <<< "$chosen"
  [ "$without_right" -eq 0 ] || [ "$without_right" -eq "$frames" ] ||
    miss "$without_right of $frames chosen images have no right image beside them; add or remove them all"
fi
stop_if_missing
echo "New College: $frames of $count images$([ "$without_right" -eq 0 ] || echo ", left camera only")"

prepare_apps
mkdir -p "$output"
write_calibration \
  "New College, rectified pair: http://www.robots.ox.ac.uk/NewCollegeData/index.php?n=Main.Details" \
  "389.956085 389.956085 254.903519 201.899490 512 384" \
  "baseline 0.120005"
# images-to-rawlog takes all of one folder.
links=$(mktemp -d)
trap 'rm -rf "$links"' EXIT
while read -r _ left; do
  ln -s "$left" "$links/"
  [ "$without_right" -gt 0 ] || ln -s "${left%-left.pnm}-right.pnm" "$links/"
done <<< "$chosen"
convert new_college --format newcollege --images "$links" --calib "$calibration"
find_loops
score_labels
say_where_results_are
