#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to loop closures: installs, builds, gets the model, runs the main job.
set -euo pipefail

usage="Usage: demo.sh RAWLOG | IMAGE_FOLDER [OUTPUT_FOLDER]
Installs the Debian packages (root or sudo), builds, gets the network's model and finds the loop
closures of a rawlog, or of a folder of images, taken by name at DEMO_RATE (1) images a second.
Results go to OUTPUT_FOLDER (demo-results). DEMO_CONFIG names another .ini than config-ini/default.ini."

case "${1:-}" in
  --help | -h) echo "$usage"; exit 0 ;;
  "") echo "demo.sh: name a rawlog or a folder of images" >&2; echo "$usage" >&2; exit 2 ;;
esac
[ -e "$1" ] || { echo "demo.sh: $1 does not exist" >&2; exit 1; }
input=$(realpath "$1")
output=$(realpath -m "${2:-demo-results}")
here=$(dirname "$(realpath "$0")")
root=$(dirname "$here")
config=$(realpath -m "${DEMO_CONFIG:-$root/config-ini/default.ini}")

"$here/install-deps.sh"
cd "$root"
cmake --preset release > /dev/null
cmake --build --preset release
"$here/get-model.sh"
bin=build/release/apps

rawlog=$input
if [ -d "$input" ]; then
  mkdir -p "$output"
  rawlog="$output/images.rawlog"
  rm -rf "$rawlog" "$output/images_Images"
  "$bin/images-to-rawlog/images-to-rawlog" --images "$input" --rate "${DEMO_RATE:-1}" --output "$rawlog"
fi
"$bin/rawlog-loop-closure/rawlog-loop-closure" --rawlog "$rawlog" --config "$config" --output "$output"
cat << EOF
Results are in $output:
  frames.csv    every camera frame with its verdict and the reason
  loops.csv     the loop closures
  matches/      pictures of them
  summary.json  counts, options, times, versions
EOF
