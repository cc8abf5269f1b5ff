#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Fetches the charts of report.html; see --help.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/npm_package.sh"

package=echarts
version=6.1.0
tarball_sha512=ab4c9a14f8200bd15476c587e1b95abd15859b176b22875b92828d02326e74023a080f6034fc47b55d917193447a9655964e32bc16243a46e4e87215a48c8764
# The files of the package that are kept, and their sums.
files=(dist/echarts.min.js LICENSE NOTICE)
sha256=(
    b66b25aeb4df84e33199dc21694014d336d222cbd9deb0e5a7c14bd6aa0d0fd0
    634293835b43a6dd2094fa39182a3d9a6b9ca43b7fdb9ac354e8037af2a3093a
    d491d358344f842685c1b1585970999db65fe30ecf7ef3867af8814f4016c016
)

usage() {
    cat <<USAGE
Usage: get-charts.sh [--output FOLDER]

Fetches Apache ECharts (npm package $package $version, 12 MB) and checks it. The build puts it into
loop-closure-report and rawlog-loop-closure, and they put it into report.html. Nothing is done when
FOLDER already holds it, intact.

  --output FOLDER  default: \${XDG_DATA_HOME:-~/.local/share}/mrpt-fild/echarts; tell CMake of
                   another one with -DFILD_CHARTS_DIR=FOLDER
  --help           this text

Needs: npm or python3
Licence: Apache-2.0 (The Apache Software Foundation); it is fetched, not part of mrpt-fild, and its
LICENSE and NOTICE go into every report.
USAGE
}

is_intact() {
    local i path
    for i in "${!files[@]}"; do
        path=$1/$(basename "${files[i]}")
        [[ -f $path && $(sum_of sha256sum "$path") == "${sha256[i]}" ]] || return 1
    done
}

# Each file appears under its name only when it is complete.
install_charts() {
    local i name
    for i in "${!files[@]}"; do
        name=$(basename "${files[i]}")
        check_sum sha256sum "$work/package/${files[i]}" "${sha256[i]}" "$name"
        cp "$work/package/${files[i]}" "$output/$name.part.$$"
        mv "$output/$name.part.$$" "$output/$name"
    done
    echo "wrote $output"
}

parse_arguments echarts "a folder name" "$@"
if is_intact "$output"; then
    echo "$output is already there and intact"
    exit 0
fi
[[ ! -e $output || -d $output ]] || fail "$output is no folder"
work=$(mktemp -d)
trap 'rm -rf "$work" "$output"/*.part.$$' EXIT
fetch_package "$package" "$version" "$tarball_sha512" "$work" "${files[@]/#/package/}"
mkdir -p "$output"
install_charts
