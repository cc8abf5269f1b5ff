#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Fetches the network behind the global descriptor and converts it to ONNX; see --help.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/npm_package.sh"

# The detector's network is part of an npm package; its other half, the box predictors, is of no use here.
package=@mediapipe/objectron
version=0.4.1675468480
tarball_sha512=2285ae5b4a2373d19a496e94a030885e0c232d2a9311c479c3c358b861fe479faafa72b34bb28e2067d8fdecb1e03b6d45eba66f7f7c5baf8fa56d0343646cff
assets=package/objectron_solution_packed_assets.data
tflite_first_byte=185 # counted from 1: the label list before it fills 184 bytes
tflite_sha256=d0a5255bf8c4f5a0bc4240741a76c41d5e939f7655078f945f50ab53a9375da6
# As written with Debian 12's python3-onnx 1.12. The numbers in it are fixed by the two sums above.
onnx_sha256=ce0d89b92906142730db67cc544dce1910e88765bae271d64caa2f8e2eb07d6e
backbone=FeatureExtractor/MobilenetV2
layers=("$backbone/expanded_conv_14/add" "$backbone/Conv_1/Relu6")

usage() {
    cat <<EOF
Usage: get-model.sh [--output FILE]

Fetches MobileNetV2 (npm package $package $version, 33 MB), checks it and converts
its backbone to ONNX. Nothing is done when FILE is already there and intact.

  --output FILE  default: \${XDG_DATA_HOME:-~/.local/share}/mrpt-fild/mobilenet_v2_objectron.onnx
  --help         this text

FILE.sha256 is written beside it. Input of the network: 1x3x300x300, RGB, (pixel - 127.5) / 127.5.
Outputs: ${layers[0]} (160x10x10)
         ${layers[1]} (1280x10x10)

Needs: apt install python3-flatbuffers python3-numpy python3-onnx
Licence: the network is Apache-2.0 (MediaPipe, by Google). It is fetched, not part of mrpt-fild.
EOF
}

# True when FILE is the recorded conversion, or the one that an earlier run noted beside it.
is_intact() {
    local got noted=
    [[ -f $1 ]] || return 1
    got=$(sum_of sha256sum "$1")
    if [[ -f $1.sha256 ]]; then
        read -r noted _ <"$1.sha256" || true
    fi
    [[ $got == "$onnx_sha256" || $got == "$noted" ]]
}

check_tools() {
    [[ -x $python ]] || fail "$python is not installed; try: apt install python3"
    local module missing=()
    for module in flatbuffers numpy onnx; do
        "$python" -c "import $module" 2>/dev/null || missing+=("python3-$module")
    done
    ((${#missing[@]} == 0)) || fail "Python modules are missing; try: apt install ${missing[*]}"
}

# Leaves the TFLite network in $work/model.tflite.
fetch_tflite() {
    fetch_package "$package" "$version" "$tarball_sha512" "$work" "$assets"
    tail -c +"$tflite_first_byte" "$work/$assets" >"$work/model.tflite"
    check_sum sha256sum "$work/model.tflite" "$tflite_sha256" "the network in the package"
}

# Leaves the ONNX network in $work/model.onnx.
convert_to_onnx() {
    local layer until=()
    for layer in "${layers[@]}"; do
        until+=(--until "$layer")
    done
    "$python" "$here/tflite_to_onnx.py" "$work/model.tflite" "$work/model.onnx" "${until[@]}"
    local got
    got=$(sum_of sha256sum "$work/model.onnx")
    if [[ $got != "$onnx_sha256" ]]; then
        echo "get-model.sh: warning: converted from the right network, but written differently than by" \
            "python3-onnx 1.12: sha256 $got, recorded $onnx_sha256" >&2
    fi
}

# Both files appear under their names only when complete.
install_model() {
    cp "$work/model.onnx" "$partial"
    local got
    got=$(sum_of sha256sum "$partial")
    echo "$got  $(basename "$output")" >"$partial.sha256"
    mv "$partial" "$output"
    mv "$partial.sha256" "$output.sha256"
    echo "wrote $output (sha256 $got)"
}

parse_arguments mobilenet_v2_objectron.onnx "a file name" "$@"
if is_intact "$output"; then
    echo "$output is already there and intact"
    exit 0
fi
[[ ! -d $output ]] || fail "$output is a folder; give a file name"
[[ ! -e $output ]] || echo "$output is there but not intact; it will be replaced"
check_tools
mkdir -p "$(dirname "$output")"
partial=$output.part.$$
work=$(mktemp -d)
trap 'rm -rf "$work" "$partial" "$partial.sha256"' EXIT
fetch_tflite
convert_to_onnx
install_model
