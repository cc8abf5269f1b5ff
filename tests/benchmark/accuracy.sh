#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures accuracy on all sets and writes the table of accuracy.md; see --help.
set -euo pipefail

repository=$(realpath "$(dirname "$(realpath "$0")")/../..")
usage="Usage: accuracy.sh [OUTPUT_FOLDER]

Runs the detector on every set, with several seeds: with the paper's configuration, with default.ini, with
default.ini and 10 s of look-ahead, and with default.ini whose [same_place] coefficients are fitted to the
other sets only (left out). Writes OUTPUT_FOLDER/accuracy.md (accuracy-results), which
tests/benchmark/accuracy.md is a copy of, the coefficients fitted to all sets (coefficients.ini), and all
results beside it. Results that are there already are kept: remove OUTPUT_FOLDER to measure anew. Takes
some three hours on two cores.

Environment:
  FILD_APPS=FOLDER   the apps: apps/ of a build or bin/ of an installation (build/release/apps)
  FILD_DATA=FOLDER   the test data (../shared/data)
  SEEDS=1-10         of every run
  FIT_SEEDS=1        of the runs that the coefficients are fitted to"

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
fit_seeds=${FIT_SEEDS:-1}

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

for needed in corridor/loops.txt kitti03/poses_kitti.txt gardens_point/loops_day.txt \
  hololens/loops.txt tum_fr1_xyz/groundtruth.txt euroc_v101/poses_cam0.tum office_tower/floors.txt; do
  [ -f "$data/$needed" ] || fail "$data/$needed is missing; FILD_DATA=FOLDER says where the test data are"
done
"$repository/datasets-scripts/get-model.sh" > /dev/null
mkdir -p "$output"
cd "$output"

# recording NAME ARGUMENT...: of the images that NAME.txt lists.
recording() {
  local name=$1
  shift
  [ -f "$name.rawlog" ] || app images-to-rawlog --list "$name.txt" --output "$name.rawlog" "$@"
}

# kitti_recording NAME FRAME...: images and poses in that order, 10 a second.
kitti_recording() {
  local name=$1 frame
  shift
  for frame; do printf '%s/kitti03/images/%06d.jpg\n' "$data" "$frame"; done > "$name.txt"
  for frame; do sed -n "$((frame + 1))p" "$data/kitti03/poses_kitti.txt"; done > "$name.poses.txt"
  recording "$name" --rate 10
}

# Every set: NAME.rawlog, how it is judged, and the delay.
declare -A truth=(
  [corridor]="$data/corridor/loops.txt"
  [gardens-day]="$data/gardens_point/loops_day.txt"
  [gardens-night]="$data/gardens_point/loops_night.txt"
  [hololens]="$data/hololens/loops.txt"
  [tum-xyz]="$data/tum_fr1_xyz/groundtruth.txt --protocol radius:0.5,100 --min-age 10"
  [euroc]="$data/euroc_v101/poses_cam0.tum --protocol radius:2.5,4 --min-age 20"
  [kitti03-twice]="kitti03-twice.poses.txt --protocol radius:5,30 --min-age 20"
  [kitti03-once]="kitti03-once.poses.txt --protocol radius:5,30 --min-age 20"
  [office-tower]="office-tower.loops.txt"
  [town]="town.loops.txt"
  [town-hard]="town-hard.loops.txt"
)
declare -A delay=([hololens]=8 [tum-xyz]=10)
sets=(corridor gardens-day gardens-night hololens tum-xyz euroc kitti03-twice kitti03-once
  office-tower town town-hard)
fitted=(corridor gardens-day hololens tum-xyz euroc kitti03-twice kitti03-once office-tower town town-hard)

printf '%s\n' "$data"/corridor/images/*.jpg > corridor.txt
recording corridor --rate 1
for light in day night; do
  sed -e '/^#/d' -e '/^$/d' -e "s|^|$data/gardens_point/|" "$data/gardens_point/list_$light.txt" > "gardens-$light.txt"
  recording "gardens-$light" --rate 1
done
printf '%s\n' "$data"/hololens/images/* > hololens.txt
recording hololens --rate 2.5 --calib "$data/hololens/calib.txt"
awk -v data="$data/tum_fr1_xyz/" '!/^#/ {print data $2, $1}' "$data/tum_fr1_xyz/rgb.txt" > tum-xyz.txt
recording tum-xyz --calib "$data/tum_fr1_xyz/calib.txt"
for image in "$data"/euroc_v101/left/*; do
  nanoseconds=$(basename "$image" _0.jpg)
  echo "$image ${nanoseconds:0:-9}.${nanoseconds: -9}"
done > euroc.txt
awk '$1 == "left" {$1 = ""; print}' "$data/euroc_v101/calib_raw.txt" > euroc.calib.txt
recording euroc --calib euroc.calib.txt
printf '%s\n' "$data"/office_tower/images/* > office-tower.txt
recording office-tower --rate 1
# No loop between floors is right; within a floor nobody knows.
awk '!/^#/ {floor[$1] = $2; for (c = 0; c < $1; ++c) if (floor[c] == $2) print $1, c, 0}' \
  "$data/office_tower/floors.txt" > office-tower.loops.txt
# shellcheck disable=SC2046 # one number each
kitti_recording kitti03-twice $(seq 0 2 498) $(seq 1 2 499)
# shellcheck disable=SC2046
kitti_recording kitti03-once $(seq 0 499)
[ -f town.rawlog ] || app synthetic-rawlog --preset demo --output town.rawlog --quiet
[ -f town-hard.rawlog ] || app synthetic-rawlog --preset hard --output town-hard.rawlog --quiet

# measure SET FOLDER CONFIGURATION SEEDS [ARGUMENT]...
measure() {
  local set=$1 folder=$2 config=$3 seeds=$4
  shift 4
  [ ! -f "$folder/sweep.csv" ] || return 0
  echo "$folder" >&2
  # shellcheck disable=SC2086 # words
  app loop-closure-eval --quiet --rawlog "$set.rawlog" --ground-truth ${truth[$set]} --seeds "$seeds" \
    --config "$repository/config-ini/$config.ini" --set "index.delay_seconds=${delay[$set]:-20}" "$@" \
    --output "$folder" > /dev/null
}

# fit [ARGUMENT]...
fit() {
  local set arguments=()
  for set in "${fitted[@]}"; do arguments+=("$set=$set/pairs"); done
  /usr/bin/python3 "$repository/tests/benchmark/fit_same_place.py" "${arguments[@]}" \
    --look-alikes office-tower,town,town-hard "$@"
}

for set in "${fitted[@]}"; do  # every candidate of every frame, for the fit
  measure "$set" "$set/pairs" default "$fit_seeds" --set candidates.stop_at_first=false \
    --set candidates.follow_belief=false --set consistency.belief=false
done
fit > coefficients.ini
for set in "${sets[@]}"; do
  measure "$set" "$set/fild_paper" fild_paper "$seeds"
  measure "$set" "$set/default" default "$seeds"
  measure "$set" "$set/look_ahead" default "$seeds" --set consistency.look_ahead_seconds=10
  left_out=$set
  [ "$set" != gardens-night ] || left_out=gardens-day  # the same walk
  # shellcheck disable=SC2046 # words
  measure "$set" "$set/left_out" default "$seeds" $(fit --without "$left_out" --as-overrides)
done

SEEDS=$seeds /usr/bin/python3 \
  "$repository/tests/benchmark/accuracy_table.py" "$output" > accuracy.md.part
mv accuracy.md.part accuracy.md
echo "$output/accuracy.md"
