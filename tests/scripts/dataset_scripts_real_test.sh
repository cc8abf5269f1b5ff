#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# malaga_parking_6l.sh and new_college.sh with names of the data sets, two of their images, their own
# configurations and the installed model. Exit code 77: something is not there, nothing was tested.
set -euo pipefail

if [ $# -ne 4 ]; then
  echo "Usage: dataset_scripts_real_test.sh SOURCE_DIR APPS_DIR PYTHON DATA_DIR" >&2
  exit 2
fi
source_dir=$1 python=$3 data=$4
FILD_APPS=$(realpath "$2")
export FILD_APPS
model=${XDG_DATA_HOME:-$HOME/.local/share}/mrpt-fild/mobilenet_v2_objectron.onnx
for needed in "$model" "$data/pairs/malaga6l_a.jpg" "$data/ground_truth/malaga6l_frames.txt"; do
  [ -e "$needed" ] || { echo "$needed is missing"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
frames_per_visit=5

fail() { echo "dataset_scripts_real_test.sh: $*" >&2; exit 1; }

# copies FOLDER IMAGE COLOUR: the image under the names on standard input, in the format that they ask
# for; COLOUR is `as_it_is`, or `grey` for a plain one of its size.
copies() {
  "$python" -c '
import sys, cv2
folder, source, colour = sys.argv[1:]
image = cv2.imread(source, cv2.IMREAD_UNCHANGED)
if colour == "grey":
    image[:] = 128
for name in sys.stdin.read().split():
    cv2.imwrite(f"{folder}/{name}", image)
' "$@"
}

# two_visits FOLDER NAMES FIRST_LINE SECOND_LINE IMAGE_A IMAGE_B STRIDE: five frames of a place under the
# names from FIRST_LINE of the list NAMES on, five from SECOND_LINE on, between them every STRIDEth name,
# which shows nothing: a gap would be taken for a clock that was set. FOLDER.loops.txt pairs all visits.
two_visits() {
  local i j between
  mkdir "$work/$1"
  sed -n "$3,$(($3 + frames_per_visit - 1))p" "$2" | copies "$work/$1" "$5" as_it_is
  sed -n "$(($3 + frames_per_visit + $7)),$(($4 - 1))p" "$2" | awk -v n="$7" 'NR % n == 1' > "$work/$1.between"
  copies "$work/$1" "$5" grey < "$work/$1.between"
  sed -n "$4,$(($4 + frames_per_visit - 1))p" "$2" | copies "$work/$1" "$6" as_it_is
  between=$(wc -l < "$work/$1.between")
  for ((i = 0; i < frames_per_visit; ++i)); do
    for ((j = 0; j < frames_per_visit; ++j)); do echo "$((frames_per_visit + between + i)) $j"; done
  done > "$work/$1.loops.txt"
}

# check SCRIPT FOLDER: no loop wrong; found from the second frame of the second visit on at the latest.
check() {
  local json=$work/out/$2/evaluation/exact/evaluation.json
  "$source_dir/datasets-scripts/$1" "$work/$2" "$work/out/$2" "$work/$2.loops.txt"
  grep -q '"precision": 1.0' "$json" || fail "$2: precision"
  grep -Eq '"right": [45],' "$json" || fail "$2: recall"
}

# whole_set SCRIPT FOLDER NAMES MATRIX COUNT: a list of the published frames fits its loop matrix.
whole_set() {
  local text
  mkdir "$work/$2" "$work/no-apps"
  (cd "$work/$2" && xargs touch < "$3")
  text=$(FILD_APPS=$work/no-apps "$source_dir/datasets-scripts/$1" "$work/$2" "$work/out/none" "$4" 2>&1) &&
    fail "$2: ran without apps"
  [[ $text == *"holds no images-to-rawlog"* ]] || fail "$2: $text"
  rm "$work/$2/$(tail -n 1 "$3")"
  text=$("$source_dir/datasets-scripts/$1" "$work/$2" "$work/out/none" "$4" 2>&1) && fail "$2: took one image too few"
  [[ $text == *"published loop matrices have a row for each of $5"* ]] || fail "$2: $text"
  rm -r "$work/no-apps"
}

truth=$data/ground_truth
two_visits malaga "$truth/malaga6l_frames.txt" \
  "$(grep -n 1226322120.504112 "$truth/malaga6l_frames.txt" | cut -d : -f 1)" \
  "$(grep -n 1226322307.261530 "$truth/malaga6l_frames.txt" | cut -d : -f 1)" \
  "$data/pairs/malaga6l_a.jpg" "$data/pairs/malaga6l_b.jpg" 30
check malaga_parking_6l.sh malaga
two_visits new_college "$truth/newcollege_frames_2624.txt" 1 200 \
  "$data/pairs/newcollege_a.png" "$data/pairs/newcollege_b.png" 4
check new_college.sh new_college
whole_set malaga_parking_6l.sh whole_malaga "$truth/malaga6l_frames.txt" \
  "$truth/assigning_visual_words/groundTruth_MALAGA_6L.mat" 3474
whole_set new_college.sh whole_new_college "$truth/newcollege_frames_2624.txt" \
  "$truth/botw/groundTruthNC.mat" 2624
