#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to loop closures: installs, builds, gets the model, runs the main job.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: demo.sh [RAWLOG | IMAGE_FOLDER [OUTPUT_FOLDER]]
Installs the Debian packages (root or sudo), builds, gets the network's model and finds the loop
closures of a rawlog, or of a folder of images, taken by name at DEMO_RATE (1) images a second.
Without an input (or with an empty one, \"\") it first draws a drive through a synthetic town, and scores the result against
the loops that are truly there; DEMO_PRESET is the size of the drive, tiny, demo or large (demo).
Results go to OUTPUT_FOLDER (demo-results). DEMO_CONFIG names another .ini than config-ini/default.ini.
$rerun_help"

# drive_through_town: makes $output/town.rawlog and what is beside it anew, and sets rawlog.
drive_through_town() {
  rawlog=$output/town.rawlog
  rm -rf "$rawlog" "$output"/town{_Images,.gt.tum,.loops.txt,.png}
  run_app synthetic-rawlog --preset "$DEMO_PRESET" --output "$rawlog" \
    --birds-eye "$output/town.png"
}

help_if_asked "$@"
[ $# -le 2 ] || wrong_usage "too many arguments: '$3'"
input=${1:-}
[ -z "$input" ] || [ -e "$input" ] || fail "$input does not exist"
[ -z "$input" ] || input=$(realpath "$input")
output=$(realpath -m "${2:-demo-results}")
DATASET_CONFIG=${DEMO_CONFIG:-}
choose_config default.ini
case "${DEMO_PRESET:=demo}" in
  tiny | demo | large) ;;
  *) miss "DEMO_PRESET=$DEMO_PRESET is not tiny, demo or large" ;;
esac
[ "$input" != "$output/images_Images" ] && [ "$input" != "$output/images.rawlog" ] || [ ! -d "$input" ] ||
  miss "OUTPUT_FOLDER must not hold the images, $input: they would be replaced"
stop_if_missing

if [ -z "$input" ]; then
  prepare_apps synthetic-rawlog rawlog-loop-closure loop-closure-eval
elif [ -d "$input" ]; then
  prepare_apps images-to-rawlog rawlog-loop-closure
else
  prepare_apps rawlog-loop-closure
fi
mkdir -p "$output"
rawlog=$input
if [ -z "$input" ]; then
  drive_through_town
elif [ -d "$input" ]; then
  convert images --images "$input" --rate "${DEMO_RATE:-1}"
fi
if [ -n "$input" ]; then
  find_loops
else
  find_loops "$output/town.loops.txt" exact "$output/town.gt.tum"
  for protocol in exact window:10; do score "$output/town.loops.txt" "$protocol" > /dev/null; done
fi
say_where_results_are
[ -n "$input" ] || echo "  town.png      the town and the route from the air"
