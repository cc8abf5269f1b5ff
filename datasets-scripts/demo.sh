#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 to loop closures: installs, builds, gets the model, runs the main job.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/run_dataset.sh"

usage="Usage: demo.sh RAWLOG | IMAGE_FOLDER [OUTPUT_FOLDER]
Installs the Debian packages (root or sudo), builds, gets the network's model and finds the loop
closures of a rawlog, or of a folder of images, taken by name at DEMO_RATE (1) images a second.
Results go to OUTPUT_FOLDER (demo-results). DEMO_CONFIG names another .ini than config-ini/default.ini.
$rerun_help"

help_if_asked "$@"
[ $# -ge 1 ] || wrong_usage "name a rawlog or a folder of images"
[ -e "$1" ] || fail "$1 does not exist"
input=$(realpath "$1")
output=$(realpath -m "${2:-demo-results}")
DATASET_CONFIG=${DEMO_CONFIG:-}
choose_config default.ini
stop_if_missing

prepare_apps
rawlog=$input
if [ -d "$input" ]; then
  mkdir -p "$output"
  convert images --images "$input" --rate "${DEMO_RATE:-1}"
fi
find_loops
say_where_results_are
