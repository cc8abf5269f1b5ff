#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A user's first program: installs the project into an empty folder, cuts the example out of
# docs/library.md, builds it with find_package(mrpt-fild) and runs it on two laps along a drawn wall.
set -euo pipefail

if [ $# -lt 4 ]; then
  echo "Usage: consumer_test.sh SOURCE_DIR BUILD_DIR PYTHON TINY_NETWORK [CMAKE_ARGUMENT]..." >&2
  exit 2
fi
source_dir=$1 build_dir=$2 python=$3 tiny_network=$4
cmake_arguments=("${@:5}")
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
frames_per_lap=8

fail() { echo "consumer_test.sh: $*" >&2; exit 1; }

# from_page NAME: the fenced block after the line "<!-- example: NAME -->".
from_page() {
  awk -v marker="<!-- example: $1 -->" '
    $0 == marker { marked = 1; next }
    marked && /^```/ { if (inside) exit; inside = 1; next }
    inside' "$source_dir/docs/library.md" > "$work/example/$1"
  [ -s "$work/example/$1" ] || fail "docs/library.md has no block after '<!-- example: $1 -->'"
}

cmake --install "$build_dir" --prefix "$prefix" > "$work/install.log"
! grep -rIl -e "$source_dir" -e "$build_dir" "$prefix" --include='*.cmake' --include='*.h' ||
  fail "an installed file names the tree it was built in"
for installed in share/mrpt-fild/config-ini/default.ini bin/rawlog-loop-closure \
    share/mrpt-fild/datasets-scripts/{get-model.sh,npm_package.sh} share/doc/mrpt-fild/LICENSE; do
  [ -e "$prefix/$installed" ] || fail "$installed was not installed"
done

mkdir "$work/example" "$work/images"
from_page CMakeLists.txt
from_page main.cpp
[ ! -e "$prefix/include/fild/synthetic" ] || fail "the drawn town was installed"
# What only other components need must not be looked for.
not_needed=()
for package in Ceres matio nlohmann_json OpenSSL OSMesa; do
  not_needed+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -S "$work/example" -B "$work/example/build" -DCMAKE_PREFIX_PATH="$prefix" \
  "${not_needed[@]}" "${cmake_arguments[@]}" > "$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/example/build"

"$python" "$here/draw_two_laps.py" "$work/images" "$frames_per_lap"
"$prefix/bin/images-to-rawlog" --images "$work/images" --rate 1 --output "$work/wall.rawlog"
# The shipped configuration with the tests' network, which tells little: all frames are candidates, and
# all keypoints are compared.
sed -e "s|^model_file = .*|model_file = $tiny_network|" -e 's/^\(cell_layer\|layers\) = .*/\1 = map/' \
  -e 's/^input_\(width\|height\) = .*/input_\1 = 4/' -e 's/^dimension = .*/dimension = 8/' \
  -e 's/^delay_seconds = .*/delay_seconds = 5/' -e 's/^candidates = .*/candidates = 16/' -e 's/^search = .*/search = exhaustive/' \
  "$prefix/share/mrpt-fild/config-ini/default.ini" > "$work/wall.ini"
"$work/example/build/example" "$work/wall.rawlog" "$work/wall.ini" > "$work/found.txt"
for ((i = 0; i < frames_per_lap; ++i)); do
  echo "frame $((i + frames_per_lap)) is back at frame $i"
done > "$work/expected.txt"
diff "$work/expected.txt" "$work/found.txt" || fail "the example found other loops (>) than expected (<)"

sed -i 's/COMPONENTS stream/COMPONENTS sream/' "$work/example/CMakeLists.txt"
! cmake -S "$work/example" -B "$work/misspelt" -DCMAKE_PREFIX_PATH="$prefix" \
  "${cmake_arguments[@]}" > "$work/misspelt.log" 2>&1 || fail "a component that does not exist was found"
grep -q "no component sream" "$work/misspelt.log" || fail "the error does not name the component"

if "$work/example/build/example" "$work/none.rawlog" "$work/wall.ini" 2> "$work/error.txt"; then
  fail "the example took a rawlog that is not there"
fi
grep -q none.rawlog "$work/error.txt" || fail "the example's error does not name the file"
echo "the example of docs/library.md builds and runs"
