# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034,SC2154  # variables are shared with the scripts
# What demo.sh and the scripts of the data sets share: arguments, checks, building, running, scoring.
# Sourced, not run; needs `set -euo pipefail` and the text `usage`.

self=$(basename "$0")
scripts=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
repository=$(dirname "$scripts")

environment_help="Environment:
  DATASET_CONFIG=FILE.ini  instead of the configuration above
  FILD_APPS=FOLDER         the apps as they are there (bin/ of an installation, or apps/ of a build);
                           nothing is installed, built or fetched"

loop_matrices_help="GROUND_TRUTH: labelled loops, a MATLAB loop matrix or a list; scored as exact, window:10 and
window:40. Published matrices, which do not agree with each other, so name the one you compare with:
  https://github.com/ktsintotas/assigning-visual-words-to-places   'Ground truth': KITTI 00 and 05, Malaga 6L
  https://github.com/ktsintotas/BoTW-LCD                           'groundTruth': these and New College
  https://github.com/KN-Zhang/loop-closure-detection-evaluation-codes   'GT': Malaga 6L, New College"

rerun_help="A second run into the same OUTPUT_FOLDER replaces the first one's rawlog and results."

fail() {
  echo "$self: $*" >&2
  exit 1
}

# help_if_asked [ARGUMENT]...: --help as the first argument prints the usage and ends the script.
help_if_asked() {
  case "${1:-}" in
    --help | -h)
      echo "$usage"
      exit 0
      ;;
  esac
}

wrong_usage() {
  echo "$self: $*" >&2
  echo "$usage" >&2
  exit 2
}

# What is missing or wrong, gathered so that all of it is said at once.
missing=()
miss() { missing+=("$*"); }

stop_if_missing() {
  [ ${#missing[@]} -eq 0 ] && return
  echo "$self: cannot start, nothing was written:" >&2
  printf '  %s\n' "${missing[@]}" >&2
  echo "See $self --help for what is needed and where to get it." >&2
  exit 1
}

# read_arguments DEFAULT_OUTPUT [ARGUMENT]...: sets dataset, output, ground_truth ('' for none) out of
# DATASET_FOLDER [OUTPUT_FOLDER [GROUND_TRUTH]].
read_arguments() {
  local default_output=$1
  shift
  [ $# -ge 1 ] || wrong_usage "name the folder of the data set"
  [ $# -le 3 ] || wrong_usage "too many arguments: '$4'"
  [ -d "$1" ] || fail "no such folder: $1"
  dataset=$(realpath "$1")
  output=$(realpath -m "${2:-$default_output}")
  ground_truth=
  [ -z "${3:-}" ] || ground_truth=$(realpath -m "$3")
  [ "$output" != "$dataset" ] || miss "OUTPUT_FOLDER must be another folder than the data set's: $output"
  [ -z "$ground_truth" ] || [ -f "$ground_truth" ] || miss "GROUND_TRUTH is missing: $ground_truth"
}

# choose_config FILE.ini: sets config, to DATASET_CONFIG if there is one.
choose_config() {
  config=$(realpath -m "${DATASET_CONFIG:-$repository/config-ini/$1}")
  [ -f "$config" ] || miss "the configuration is missing: $config"
}

# need_frames_of_matrix FOUND EXPECTED WHAT: a loop matrix has a row for each frame of the whole set.
need_frames_of_matrix() {
  case "$ground_truth" in
    *.mat) [ "$1" -eq "$2" ] || miss "$3: $1, but published loop matrices have a row for each of $2" ;;
  esac
}

# count_files FOLDER PATTERN: 0 when there is no such folder.
count_files() {
  if [ -d "$1" ]; then find -L "$1" -maxdepth 1 -type f -name "$2" | wc -l; else echo 0; fi
}

# app_path NAME: in $apps; a build tree has a folder for each app.
app_path() { if [ -d "$apps/$1" ]; then echo "$apps/$1/$1"; else echo "$apps/$1"; fi; }

# prepare_apps [APP]...: sets apps; installs, builds these and gets the model first unless FILD_APPS is set.
# Without arguments those that convert, run and score a data set.
prepare_apps() {
  [ $# -gt 0 ] || set -- images-to-rawlog rawlog-loop-closure loop-closure-eval
  if [ -n "${FILD_APPS:-}" ]; then
    apps=$(realpath -m "$FILD_APPS")
    local app
    for app; do
      [ -x "$(app_path "$app")" ] || fail "FILD_APPS=$FILD_APPS holds no $app"
    done
    return
  fi
  "$scripts/install-deps.sh"
  "$scripts/get-charts.sh"
  (
    cd "$repository" || exit
    cmake --preset release > /dev/null
    echo "$self: building $*; this takes a few minutes the first time"
    NINJA_STATUS="building: %p, %e s  " cmake --build --preset release --target "$@"
  )
  "$scripts/get-model.sh"
  apps=$repository/build/release/apps
}

# run_app NAME [ARGUMENT]...
run_app() {
  local program
  program=$(app_path "$1")
  shift
  "$program" "$@"
}

# write_calibration SOURCE LINE...: makes $output/calibration.txt; SOURCE says where the numbers are from.
write_calibration() {
  calibration=$output/calibration.txt
  {
    echo "# $1"
    shift
    printf '%s\n' "$@"
  } > "$calibration"
}

# convert NAME [ARGUMENT]...: makes $output/NAME.rawlog anew and sets rawlog.
convert() {
  rawlog=$output/$1.rawlog
  rm -rf "$rawlog" "$output/$1_Images" "$output/$1.gt.tum"
  shift
  run_app images-to-rawlog --output "$rawlog" "$@"
}

# find_loops [TRUTH PROTOCOL [TRAJECTORY]]: the main job on $rawlog with $config, and with $images_dir instead of the
# usual one if that is set; TRUTH, and true poses beside labels, go into its report. The scores of an earlier run go, as its results do.
images_dir=
find_loops() {
  rm -f "$output"/evaluation/*/{evaluation.{json,tex},precision_recall.{svg,png}} \
    "$output"/evaluation/*/{wrong_loops,missed_loops,curve_inliers,curve_similarity,stretches,runs}.csv
  [ ! -d "$output/evaluation" ] || find "$output/evaluation" -depth -type d -empty -delete
  run_app rawlog-loop-closure --rawlog "$rawlog" --config "$config" --output "$output" \
    ${images_dir:+--set "input.images_dir=$images_dir"} \
    ${1:+--ground-truth "$1" --protocol "$2"} ${3:+--true-trajectory "$3"}
}

# score TRUTH PROTOCOL [ARGUMENT]...: prints the score, and writes it into $output/evaluation/.
score() {
  local truth=$1 protocol=$2
  shift 2
  echo
  run_app loop-closure-eval --run "$output" --ground-truth "$truth" --protocol "$protocol" \
    --output "$output/evaluation/${protocol/:/_}" "$@"
}

# score_labels: against GROUND_TRUTH, as published results do.
score_labels() {
  if [ -z "$ground_truth" ]; then
    echo "No GROUND_TRUTH was given: no score against labelled loops."
    return
  fi
  local protocol
  for protocol in exact window:10 window:40; do score "$ground_truth" "$protocol"; done
}

say_where_results_are() {
  echo
  echo "Results are in $output:"
  echo "  report.html   all of it to look at, in a browser"
  [ ! -f "$output/map_top.png" ] ||
    echo "  map_top.png   the map; map_perspective.png and map.3Dscene, for SceneViewer3D"
  cat << EOF
  frames.csv    every camera frame with its verdict and the reason
  loops.csv     the loop closures, with metric pose and weight where there is scale
  matches/      pictures of them
  summary.json  counts, options, times, versions
EOF
  [ ! -d "$output/evaluation" ] ||
    echo "  evaluation/   the scores by each protocol, with curves, tables and the wrong loops"
}
