#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is needed, builds, and runs every check and test. CI runs exactly this. With
# FILD_FULL_TESTS=1 the long ones are run in full.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."

others="slow|dataset|graphslam|browser|scripts|fuzz|kill"  # labels

step() { printf '\n== %s (%d s)\n' "$*" "$SECONDS"; }

step "packages"
datasets-scripts/install-deps.sh --tests

step "model and charts"
datasets-scripts/get-model.sh
datasets-scripts/get-charts.sh

step "formatting"
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror

# Each test runs once: the short ones below, with the sanitizers, the others here, optimised.
step "build (preset dev, warnings are errors)"
cmake --preset dev -DFILD_BUILD_GRAPHSLAM=ON -DFILD_CHECK_TYPE_NAMES=ON \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 > /dev/null
cmake --build --preset dev --target libs/all apps/all type_names \
  slow_tests dataset_tests graphslam_tests fild_fuzz kill_at_rename tiny_network

step "clang-tidy"
tests/tidy.sh

step "tests (preset dev)"  # some wait more than they compute
ctest --preset dev --parallel 3 --label-regex "$others"

step "build and tests (preset asan)"
cmake --preset asan > /dev/null
cmake --build --preset asan --target unit_tests integration_tests
ctest --preset asan --parallel 2 --label-exclude "$others"

step "done"
