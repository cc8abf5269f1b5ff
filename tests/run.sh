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

step "clang-tidy"
run-clang-tidy -quiet -p build/dev -extra-arg=-Wno-unknown-warning-option \
  "$PWD/(libs|apps|tests)/.*\.cpp" > build/tidy.log 2>&1 || {
  grep -A5 'error:' build/tidy.log >&2
  exit 1
}

step "tests (preset dev)"
ctest --preset dev --parallel 2
step "build and unit tests (preset asan)"
cmake --preset asan > /dev/null
cmake --build --preset asan
ctest --preset asan --parallel 2 --label-exclude "dataset|browser"

step "done"
