#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is needed, builds, and runs every check and test. CI runs exactly this.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."

step() { printf '\n== %s (%d s)\n' "$*" "$SECONDS"; }

step "packages"
datasets-scripts/install-deps.sh --tests

step "model"
datasets-scripts/get-model.sh

step "formatting"
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror

step "build (preset dev, warnings are errors)"
cmake --preset dev > /dev/null
cmake --build --preset dev

step "tests (preset dev)"
ctest --preset dev --parallel 2
step "done"
