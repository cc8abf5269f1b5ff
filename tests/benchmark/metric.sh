#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# How good the maps of drawn towns are: makes the table of metric_errors.py. Takes some minutes a row.
set -euo pipefail

usage="Usage: metric.sh BUILD_FOLDER WORK_FOLDER [SEED]...
Draws the demo town of each seed (1) for a stereo, a depth and a single camera, with odometry and GPS of 2 cm; runs
rawlog-loop-closure with the sources of motion one by one and together, MRPT's graph-slam (3D, and 2D on the single camera's map) and, where BUILD_FOLDER has it
(-DFILD_BUILD_BENCHMARKS=ON), false_loops with 30 % false loops. What is in WORK_FOLDER already is not made again."

fail() { echo "metric.sh: $1" >&2; exit 1; }

[ "${1:-}" != --help ] || { echo "$usage"; exit 0; }
[ $# -ge 2 ] || { echo "$usage" >&2; exit 2; }
build=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
config=$here/../../config-ini/default.ini
[ -x "$build/apps/rawlog-loop-closure/rawlog-loop-closure" ] || fail "no apps in $build"
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- 1

draw() { # NAME FLAG...
  [ -e "$1.rawlog" ] ||
    "$build/apps/synthetic-rawlog/synthetic-rawlog" --preset demo --output "$1.rawlog" --quiet "${@:2}" >&2
}
find_loops() { # RAWLOG RUN FLAG...
  [ -e "$2/summary.json" ] ||
    "$build/apps/rawlog-loop-closure/rawlog-loop-closure" --rawlog "$1.rawlog" --config "$config" \
      --output "$2" --quiet --set render.max_match_pictures=0 "${@:3}" >&2
}
row() { # NAME RUN TOWN [3d|2d]
  local after=()
  if [ $# -gt 3 ] && command -v graph-slam > /dev/null; then
    after=("$2/slam.graph")
    graph-slam "--$4" --levmarq -i "$2/poses.graph" -o "${after[0]}" > /dev/null
  fi
  /usr/bin/python3 "$here/metric_errors.py" "$1" "$2" "$3.gt.tum" "${after[@]}"
}

/usr/bin/python3 "$here/metric_errors.py" --header
motion() { # TOWN SOURCES NAME [3d|2d]
  local run="$1-${2//,/-}"
  find_loops "$1" "$run" --set "graph.motion_sources=$2"
  row "$3" "$run" "$1" "${@:4}"
}
for seed in "$@"; do
  for sensor in stereo rgbd mono; do
    town=$sensor-$seed
    draw "$town" --sensor "$sensor" --seed "$seed" --set sensors.gps=true --set sensors.gps_noise_m=0.02
    motion "$town" odometry,vision "$sensor, seed $seed" 3d
    if [ "$sensor" != mono ]; then
      motion "$town" odometry "$sensor, odometry alone, seed $seed" 3d
      motion "$town" vision "$sensor, images alone, seed $seed" 3d
    fi
    motion "$town" gps,vision "$sensor with GPS, without odometry, seed $seed"
    motion "$town" auto "$sensor with GPS and odometry, seed $seed"
  done
  find_loops "mono-$seed" "mono-$seed-2d" --set graph.motion_sources=odometry --set graph.graph_dimensions=2d
  row "mono, seed $seed, 2D" "mono-$seed-2d" "mono-$seed" 2d
done
false_loops=$build/tests/benchmark/false_loops
[ ! -x "$false_loops" ] || for seed in "$@"; do
  for sensor in stereo rgbd mono; do
    town=$sensor-$seed
    echo "$sensor, seed $seed: $("$false_loops" "$town.rawlog" "$town-odometry-vision" "$town.gt.tum" 0.3)"
  done
done
