#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The scripts of the data sets, on small drawn folders laid out and named as the data sets are: what they
# find, how they score it, and what they say is missing. Nothing is installed, built or fetched.
set -euo pipefail

if [ $# -ne 4 ]; then
  echo "Usage: dataset_scripts_test.sh SOURCE_DIR APPS_DIR PYTHON TINY_NETWORK" >&2
  exit 2
fi
source_dir=$1 python=$3 tiny_network=$(realpath "$4")
FILD_APPS=$(realpath "$2")
export FILD_APPS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
frames_per_lap=8
failures=0

# The shipped configuration with the tests' network, which tells little: all frames are candidates, and
# all keypoints are compared.
sed -e "s|^model_file = .*|model_file = $tiny_network|" -e 's/^\(cell_layer\|layers\) = .*/\1 = map/' \
  -e 's/^input_\(width\|height\) = .*/input_\1 = 4/' -e 's/^dimension = .*/dimension = 8/' \
  -e 's/^delay_seconds = .*/delay_seconds = 35/' -e 's/^candidates = .*/candidates = 16/' -e 's/^search = .*/search = exhaustive/' \
  "$source_dir/config-ini/default.ini" > "$work/wall.ini"
sed -e 's/^delay_seconds = .*/delay_seconds = 7/' "$work/wall.ini" > "$work/wall_at_one_hertz.ini"
export DATASET_CONFIG=$work/wall.ini

# draw KIND FOLDER: $work/FOLDER
draw() { "$python" "$source_dir/tests/scripts/draw_data_sets.py" "$1" "$work/$2" "$frames_per_lap"; }

# run_script NAME ARGUMENT...: in $work; sets code and text (both streams).
run_script() {
  local name=$1
  shift
  code=0
  text=$(cd "$work" && "$source_dir/datasets-scripts/$name" "$@" 2>&1) || code=$?
}

# expect WHAT COMMAND...: the command must succeed.
expect() {
  local what=$1
  shift
  if "$@"; then
    echo "ok: $what"
  else
    echo "FAILED: $what; exit code $code, output: $text"
    failures=$((failures + 1))
  fi
}

says() { [[ $text == *"$1"* ]]; }
exits_with() { [[ $code == "$1" ]]; }
is_absent() { [[ ! -e $work/$1 ]]; }
frames_are() { [[ $(tail -n +2 "$work/$1/frames.csv" | wc -l) == "$2" ]]; }

# scored RESULTS PROTOCOL: all loops were found, and no wrong one.
scored() {
  local json=$work/$1/evaluation/$2/evaluation.json
  grep -q "\"loop_queries\": $frames_per_lap," "$json" && grep -q '"precision": 1.0' "$json" &&
    grep -q '"recall": 1.0' "$json"
}

test_kitti() {
  draw kitti kitti
  run_script kitti_odometry.sh 00 kitti out/kitti kitti.loops.txt
  expect "kitti: exit code 0" exits_with 0
  expect "kitti: stereo" says "16 frames of 32 images"
  expect "kitti: scored by poses" scored out/kitti radius_5
  expect "kitti: scored by labels" scored out/kitti exact
  expect "kitti: and by labels nearby" scored out/kitti window_40
  expect "kitti: says where the results are" says "Results are in $work/out/kitti"

  rm -r "$work/kitti/sequences/00/image_1" "$work/kitti/poses"
  run_script kitti_odometry.sh 00 kitti out/kitti
  expect "kitti, again with less: exit code 0" exits_with 0
  expect "kitti, again with less: one camera" says "left camera only"
  expect "kitti, again with less: no score by distance" says "no score by distance"
  expect "kitti, again with less: the new rawlog" says "16 frames of 16 images"
  expect "kitti, again with less: the old scores are gone" is_absent out/kitti/evaluation

  touch "$work/matrix.mat"
  rm "$work/kitti/sequences/00/times.txt"
  run_script kitti_odometry.sh 00 kitti out/none matrix.mat
  expect "kitti, incomplete: exit code 1" exits_with 1
  expect "kitti, incomplete: names what is missing" says "sequences/00/times.txt is missing"
  expect "kitti, incomplete: and what does not fit" says "16, but published loop matrices have a row for each of 4541"
  expect "kitti, incomplete: writes nothing" is_absent out/none
  run_script kitti_odometry.sh 05 kitti out/none
  expect "kitti, absent sequence: named" says "sequences/05/image_0: no PNG images"
}

test_malaga() {
  draw malaga malaga
  run_script malaga_parking_6l.sh malaga out/malaga malaga.loops.txt
  expect "malaga: exit code 0" exits_with 0
  expect "malaga: says how much of the set it is" says "16 of 3474 images"
  expect "malaga: scored" scored out/malaga exact
  expect "malaga: time stamps of the names" grep -q '^1,1226322040.529528,CAMERA_LEFT,' "$work/out/malaga/frames.csv"
  expect "malaga: calibration written" grep -q '^923.5295 922.2418 .* 1024 768 -0.353754' "$work/out/malaga/calibration.txt"

  local left
  for left in "$work"/malaga/CAMERA_LEFT_*; do
    cp "$left" "$(sed 's/LEFT/RIGHT/; s/529528/533012/' <<< "$left")"
  done
  run_script malaga_parking_6l.sh malaga out/left_only
  expect "malaga, no pose of the right camera: exit code 0" exits_with 0
  expect "malaga, no pose of the right camera: says so" says "16 right images are left out"
  echo "923.5 922.2 507.2 383.6 1024 768 -0.353754 0.162014 0.001643379 0.0003655471
right 911.4 909.4 519.4 409.0 1024 768
right_pose 0.8 0 0 0 0 0 1" > "$work/malaga/calibration.txt"
  run_script malaga_parking_6l.sh malaga out/both malaga.loops.txt
  expect "malaga, both cameras: exit code 0" exits_with 0
  expect "malaga, both cameras: two streams" says "16 frames of 32 images"
  expect "malaga, both cameras: pairs" grep -q '"frames_with_right_image": 16' "$work/out/both/summary.json"
  expect "malaga, both cameras: scored" scored out/both exact

  mkdir "$work/malaga_rawlog"
  cp "$work/out/malaga/malaga_parking_6l.rawlog" "$work/malaga_rawlog/6l.rawlog.gz"
  cp -r "$work/out/malaga/malaga_parking_6l_Images" "$work/malaga_rawlog/6l_Images"
  run_script malaga_parking_6l.sh malaga_rawlog out/native malaga.loops.txt
  expect "malaga's rawlog: exit code 0" exits_with 0
  expect "malaga's rawlog: as it is" says "6l.rawlog.gz as it is"
  expect "malaga's rawlog: not converted" is_absent out/native/malaga_parking_6l.rawlog
  expect "malaga's rawlog: scored" scored out/native exact

  mkdir "$work/empty"
  run_script malaga_parking_6l.sh empty out/none absent.mat
  expect "malaga, empty: exit code 1" exits_with 1
  expect "malaga, empty: says what is missing" says "neither a .rawlog nor CAMERA_LEFT_SECONDS.jpg images"
  expect "malaga, empty: the truth too" says "GROUND_TRUTH is missing"
  expect "malaga, empty: writes nothing" is_absent out/none
  touch "$work/empty/a.rawlog" "$work/empty/b.rawlog.gz"
  run_script malaga_parking_6l.sh empty out/none
  expect "malaga, two rawlogs: named" says "a.rawlog b.rawlog.gz"
}

test_new_college() {
  draw newcollege new_college
  DATASET_CONFIG=$work/wall_at_one_hertz.ini run_script new_college.sh new_college out/new_college new_college.loops.txt
  expect "new college: exit code 0" exits_with 0
  expect "new college: every 20th image" says "16 of 320 images"
  expect "new college: stereo" says "16 frames of 32 images"
  expect "new college: from the first on" grep -q '^1,1225719816.004878,' "$work/out/new_college/frames.csv"
  expect "new college: scored" scored out/new_college exact

  mkdir "$work/one_hertz"
  cp "$work"/new_college/*/StereoImage__*.004878-left.pnm "$work/one_hertz"
  DATASET_CONFIG=$work/wall_at_one_hertz.ini run_script new_college.sh one_hertz out/one_hertz
  expect "new college at 1 Hz: exit code 0" exits_with 0
  expect "new college at 1 Hz: every image" frames_are out/one_hertz 16
  expect "new college at 1 Hz: one camera" says "left camera only"

  cp "$work"/new_college/*/StereoImage__1225719815.004878-right.pnm "$work/one_hertz"
  run_script new_college.sh one_hertz out/none
  expect "new college, some right images: exit code 1" exits_with 1
  expect "new college, some right images: counted" says "15 of 16 chosen images have no right image"
  expect "new college, some right images: writes nothing" is_absent out/none
  run_script new_college.sh kitti out/none
  expect "new college, absent: says so" says "no StereoImage__SECONDS-left.pnm"
}

test_tum() {
  draw tum freiburg3_wall
  run_script tum_rgbd.sh freiburg3_wall out/tum
  expect "tum: exit code 0" exits_with 0
  expect "tum: depth" says "16 frames of 16 images and 16 depth images"
  expect "tum: the camera of the name" grep -q '^535.4 539.2 ' "$work/out/tum/calibration.txt"
  expect "tum: scored" scored out/tum radius_0.5

  mv "$work/freiburg3_wall" "$work/wall"
  rm "$work/wall/depth.txt" "$(find "$work/wall/rgb" -name '*.png' | head -n 1)"
  run_script tum_rgbd.sh wall out/none
  expect "tum, incomplete: exit code 1" exits_with 1
  expect "tum, incomplete: asks for the camera" says "TUM_CAMERA=1, 2 or 3"
  expect "tum, incomplete: names the file" says "depth.txt is missing"
  expect "tum, incomplete: counts the images" says "15 images, rgb.txt lists 16"
  expect "tum, incomplete: writes nothing" is_absent out/none
}

test_demo() {
  mkdir "$work/images"
  "$python" "$source_dir/tests/consumer/draw_two_laps.py" "$work/images" "$frames_per_lap"
  DEMO_CONFIG=$work/wall_at_one_hertz.ini run_script demo.sh images out/demo
  expect "demo: exit code 0" exits_with 0
  expect "demo: frames" frames_are out/demo 16
  DEMO_CONFIG=$work/wall_at_one_hertz.ini run_script demo.sh out/demo/images.rawlog out/rawlog
  expect "demo of a rawlog: exit code 0" exits_with 0
}

test_demo_town() {
  DEMO_PRESET=tiny DEMO_CONFIG=$work/wall_at_one_hertz.ini run_script demo.sh
  expect "demo without an argument: exit code 0" exits_with 0
  expect "demo without an argument: the town from the air" test -s "$work/demo-results/town.png"
  expect "demo without an argument: frames" frames_are demo-results 60
  expect "demo without an argument: scored" test -s "$work/demo-results/evaluation/exact/evaluation.json"
  DEMO_PRESET=huge run_script demo.sh
  expect "demo of a preset that is none: exit code 1" exits_with 1
  run_script demo.sh absent
  expect "demo of what is not there: exit code 1" exits_with 1
  run_script demo.sh a b c
  expect "demo with too many arguments: exit code 2" exits_with 2
}

test_usage() {
  local script
  for script in malaga_parking_6l.sh new_college.sh tum_rgbd.sh; do
    run_script "$script" --help
    expect "$script --help: exit code 0" exits_with 0
    expect "$script --help: where to get the data" says "://"
    run_script "$script"
    expect "$script without an argument: exit code 2" exits_with 2
    run_script "$script" absent
    expect "$script with a folder that is not there: exit code 1" exits_with 1
    run_script "$script" empty empty
    expect "$script with its results among the data: refused" says "must be another folder"
  done
  run_script kitti_odometry.sh --help
  expect "kitti_odometry.sh --help: where to get the data" says "cvlibs.net"
  run_script kitti_odometry.sh 03 kitti
  expect "kitti_odometry.sh 03: exit code 2" exits_with 2
  FILD_APPS=$work run_script kitti_odometry.sh --help
  expect "--help needs no apps" exits_with 0
}

test_kitti
test_malaga
test_new_college
test_tum
test_demo
test_demo_town
test_usage
if ((failures > 0)); then
  echo "$failures checks failed"
  exit 1
fi
