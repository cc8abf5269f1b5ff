#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The files that ask for a kind of processor compile for arm64, with all warnings as errors; with
# FILD_FULL_TESTS=1 all files of the modules. The headers are this machine's.
set -euo pipefail

if [ $# -lt 3 ]; then
  echo "Usage: arm64_test.sh SOURCE_FOLDER FLAGS_FOLDER MODULE..." >&2
  exit 2
fi
source=$1 flags=$2
modules=("${@:3}")
compiler=aarch64-linux-gnu-g++

if ! command -v $compiler > /dev/null; then
  echo "skipped: no $compiler; install g++-aarch64-linux-gnu"
  exit 77
fi
if ! $compiler -dM -E -x c++ /dev/null | grep __aarch64__ > /dev/null; then
  echo "arm64_test.sh: $compiler does not compile for arm64" >&2
  exit 1
fi

chosen='immintrin|processor_clones\.h|__attribute__\(\(target|target_clones|__builtin_cpu|__builtin_ia32'
chosen+='|disc_windows\.h|__x86_64__|__SSE|__AVX|_mm[0-9]*_|\basm\b|cpuid'
if [ "${FILD_FULL_TESTS:-0}" = 1 ]; then chosen=; fi
# MRPT's configuration is made for one processor, and asks for its vector code.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
printf '#include <mrpt/config.h>\n#undef MRPT_ARCH_INTEL_COMPATIBLE\n#define MRPT_ARCH_INTEL_COMPATIBLE 0\n' \
  > "$scratch/not_intel.h"

compiled=0
failed=0
for module in "${modules[@]}"; do
  while read -r file; do
    compiled=$((compiled + 1))
    $compiler -c -o /dev/null -include "$scratch/not_intel.h" -Werror -Wno-psabi "@$flags/$module.flags" "$file" || {
      echo "arm64_test.sh: $file does not compile for arm64" >&2
      failed=1
    }
  done < <(grep -rlE "$chosen" "$source/libs/$module/src" --include='*.cpp' || true)
done
if [ $compiled -eq 0 ]; then
  echo "arm64_test.sh: no file was compiled" >&2
  exit 1
fi
echo "$compiled files compiled for arm64"
exit $failed
