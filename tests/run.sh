#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is needed, builds, and runs every check and test. CI runs exactly this.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."

step() { printf '\n== %s (%d s)\n' "$*" "$SECONDS"; }

step "packages"
datasets-scripts/install-deps.sh --tests

step "model and charts"
datasets-scripts/get-model.sh
datasets-scripts/get-charts.sh

step "formatting"
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror

step "build (preset dev, warnings are errors)"
cmake --preset dev -DFILD_BUILD_GRAPHSLAM=ON > /dev/null
cmake --build --preset dev

# Tests as well with the preset `tidy`, which takes as long again.
step "clang-tidy of libraries and apps"
run-clang-tidy -quiet -p build/dev "$PWD/(libs|apps)/.*\.cpp" > build/tidy.log 2>&1 || {
  grep -A5 'error:' build/tidy.log >&2
  exit 1
}

step "tests (preset dev)"
ctest --preset dev --parallel 2

# The longest, and those that run no code of ours, are left to a whole `ctest --preset asan`.
step "build and tests but the longest (preset asan)"
cmake --preset asan > /dev/null
cmake --build --preset asan --target unit_tests integration_tests
ctest --preset asan --parallel 2 --label-exclude "dataset|browser|scripts|fuzz|kill" --exclude-regex \
  '^(metric_pose_test|town_view_test|metric_map_test\..*|graph_drive_test\..*|synthetic_rawlog_test\..*)$'

step "done"
