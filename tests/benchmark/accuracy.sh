#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures accuracy on all sets and writes the table of accuracy.md; see --help.
set -euo pipefail

repository=$(realpath "$(dirname "$(realpath "$0")")/../..")
usage="Usage: accuracy.sh [OUTPUT_FOLDER]

Runs the detector on every set with the paper's and with the default configuration, with the network of
get-model.sh and with the ImageNet network among the test data, each with several seeds; then the default
configuration with one of its options as in the paper. Writes OUTPUT_FOLDER/accuracy.md (accuracy-results),
which tests/benchmark/accuracy.md is a copy of, and all results beside it. Results that are there already are
kept: remove OUTPUT_FOLDER to measure anew.

Environment:
  FILD_APPS=FOLDER   the apps: apps/ of a build or bin/ of an installation (build/release/apps)
  FILD_DATA=FOLDER   the test data (../shared/data)
  SEEDS=1-10         of every run
  FEW_SEEDS=1        where one option is changed, but on the corridor"

fail() {
  echo "accuracy.sh: $*" >&2
  exit 1
}

case "${1:-}" in
  --help) echo "$usage" && exit ;;
  -*) fail "unknown option $1; see --help" ;;
esac
output=$(realpath -m "${1:-accuracy-results}")
apps=$(realpath -m "${FILD_APPS:-$repository/build/release/apps}")
data=$(realpath -m "${FILD_DATA:-$repository/../shared/data}")
seeds=${SEEDS:-1-10}
few_seeds=${FEW_SEEDS:-1}

# app NAME [ARGUMENT]...
app() {
  local name=$1 path
  shift
  for path in "$apps/$name/$name" "$apps/$name"; do
    if [ -f "$path" ]; then
      "$path" "$@"
      return
    fi
  done
  fail "no $name in $apps; FILD_APPS=FOLDER says where the apps are"
}

for needed in "$data/corridor/loops.txt" "$data/kitti03/poses_kitti.txt" \
  "$data/models/mobilenet_v2_1.0_224_imagenet_int8.tflite"; do
  [ -f "$needed" ] || fail "$needed is missing; FILD_DATA=FOLDER says where the test data are"
done
"$repository/datasets-scripts/get-model.sh" > /dev/null
mkdir -p "$output"
cd "$output"

# kitti_recording NAME FRAME...: images and poses in that order, 10 a second.
kitti_recording() {
  local name=$1 frame
  shift
  [ ! -f "$name.rawlog" ] || return 0
  for frame; do printf '%s/kitti03/images/%06d.jpg\n' "$data" "$frame"; done > "$name.txt"
  for frame; do sed -n "$((frame + 1))p" "$data/kitti03/poses_kitti.txt"; done > "$name.poses.txt"
  app images-to-rawlog --list "$name.txt" --rate 10 --output "$name.rawlog"
}

# Every set: NAME.rawlog, and how it is judged.
declare -A truth=(
  [corridor]="--ground-truth $data/corridor/loops.txt"
  [town]="--ground-truth town.loops.txt --protocol exact"
  [kitti03-twice]="--ground-truth kitti03-twice.poses.txt --protocol radius:5 --min-age 20"
  [kitti03-once]="--ground-truth kitti03-once.poses.txt --protocol radius:5 --min-age 20"
)
sets=(corridor town kitti03-twice kitti03-once)
[ -f corridor.rawlog ] ||
  app images-to-rawlog --images "$data/corridor/images" --rate 1 --output corridor.rawlog
[ -f town.rawlog ] || app synthetic-rawlog --preset demo --output town.rawlog --quiet
# shellcheck disable=SC2046 # one number each
kitti_recording kitti03-twice $(seq 0 2 498) $(seq 1 2 499)
# shellcheck disable=SC2046
kitti_recording kitti03-once $(seq 0 499)

[ -f imagenet.onnx ] ||
  "$repository/datasets-scripts/tflite_to_onnx.py" \
    "$data/models/mobilenet_v2_1.0_224_imagenet_int8.tflite" imagenet.onnx \
    --until MobileNetV2/Conv2d_18_1/relu6/Relu6 > /dev/null
declare -A model=(
  [npm]=""
  [ImageNet]="--set global_descriptor.model_file=$output/imagenet.onnx
    --set global_descriptor.layers=MobileNetV2/Conv2d_18_1/relu6/Relu6
    --set global_descriptor.input_width=224 --set global_descriptor.input_height=224
    --set global_descriptor.pooling=average --set global_descriptor.dimension=1280"
)

# measure SET FOLDER CONFIGURATION SEEDS [ARGUMENT]...
measure() {
  local set=$1 folder=$2 config=$3 seeds=$4
  shift 4
  [ ! -f "$folder/sweep.csv" ] || return 0
  echo "$folder" >&2
  # shellcheck disable=SC2086 # words
  app loop-closure-eval --quiet --rawlog "$set.rawlog" ${truth[$set]} --seeds "$seeds" \
    --config "$repository/config-ini/$config.ini" --set index.delay_seconds=20 "$@" \
    --output "$folder" > /dev/null
}

for set in "${sets[@]}"; do
  for config in fild_paper default; do
    for network in npm ImageNet; do
      # shellcheck disable=SC2086
      measure "$set" "$set/$config-$network" "$config" "$seeds" ${model[$network]}
    done
  done
done

# What default.ini has that the paper has not, as in the paper; words are key=value.
changes=(
  "global_descriptor.layers=FeatureExtractor/MobilenetV2/Conv_1/Relu6 global_descriptor.pooling=average global_descriptor.dimension=1280"
  "local_features.min_keypoints=0"
  "index.whiten_from=0"
  "index.candidates=1"
  "hashing.search=cascade"
  "hashing.ratio=0.7"
  "hashing.mutual_check=false"
  "candidates.place_frames=0"
  "candidates.neighbour_reach=0"
  "candidates.place_memory=0"
  "candidates.stop_at_first=false"
  "verification.method=ransac"
  "verification.min_weighed_inliers=0"
  "verification.min_weighed_inlier_share=0"
  "verification.min_weighed_inliers=0 verification.min_weighed_inlier_share=0 verification.min_inliers=20"
  "consistency.consecutive_frames=2"
)
words=()
for change in "${changes[@]}"; do words+=(--change "$change"); done
for set in "${sets[@]}"; do
  [ "$set" = corridor ] && some=$seeds || some=$few_seeds
  measure "$set" "$set/changes" default "$some" "${words[@]}"
done

SEEDS=$seeds FEW_SEEDS=$few_seeds /usr/bin/python3 \
  "$repository/tests/benchmark/accuracy_table.py" "$output" > accuracy.md.part
mv accuracy.md.part accuracy.md
echo "$output/accuracy.md"
