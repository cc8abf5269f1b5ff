#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy over libraries and apps; with FILD_TIDY=all over the tests too, which takes as long again.
# It reads several files as one, as the preset `tidy` would compile them: most of its time goes into headers.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."

case "${FILD_TIDY:=apps}" in
  apps) folders="libs|apps" ;;
  all) folders="libs|apps|tests" ;;
  *) echo "tidy.sh: FILD_TIDY=$FILD_TIDY is not apps or all" >&2; exit 2 ;;
esac
cmake --preset tidy -DFILD_BUILD_GRAPHSLAM=ON > /dev/null
# A file that includes others by name is what bugprone-suspicious-include warns of.
run-clang-tidy -quiet -p build/tidy -j 2 -checks=-bugprone-suspicious-include \
  "^$PWD/(build/tidy/($folders)/.*/Unity/[^/]*\.cxx|($folders)/.*\.cpp)$" > build/tidy.log 2>&1 || {
  grep -A5 'error:' build/tidy.log >&2
  exit 1
}
