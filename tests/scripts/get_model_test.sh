#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests what datasets-scripts/get-model.sh does without a network: npm is replaced by a script of ours.
# Needs what get-model.sh needs, npm excepted.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
script=$here/../../datasets-scripts/get-model.sh
source "$here/fake_npm.sh"
model=$work/out/model.onnx

test_a_wrong_package_is_refused() {
    set_up
    fake_npm 'echo "not the package" >mediapipe-objectron-0.tgz'
    run_script --output "$model"
    expect "a wrong package: exit code 1" exits_with 1
    expect "a wrong package: says what it got" says "sha512 $(echo "not the package" | sha512sum | cut -d ' ' -f 1)"
    expect "a wrong package: says what it expected" says "expected 2285ae5b"
    expect "a wrong package: leaves nothing behind" is_empty "$work/out"
    expect "a wrong package: leaves no temporary folder" is_empty "$work/tmp"
}

test_an_intact_file_is_kept() {
    set_up
    echo "a network" >"$model"
    (cd "$work/out" && sha256sum model.onnx >model.onnx.sha256)
    run_script --output "$model"
    expect "an intact file: exit code 0" exits_with 0
    expect "an intact file: says so" says "already there and intact"
    expect "an intact file: npm is not called" npm_was_not_called
}

test_a_damaged_file_is_fetched_again_and_kept_until_then() {
    set_up
    echo "a network" >"$model"
    (cd "$work/out" && sha256sum model.onnx >model.onnx.sha256)
    echo "damaged" >"$model"
    run_script --output "$model"
    expect "a damaged file: npm is called" npm_was_called
    expect "a damaged file: a failure is reported" exits_with 1
    expect "a damaged file: it stays when npm fails" grep -q damaged "$model"
}

test_the_default_place_follows_xdg() {
    set_up
    mkdir "$work/out/mrpt-fild"
    local model=$work/out/mrpt-fild/mobilenet_v2_objectron.onnx
    echo "a network" >"$model"
    sha256sum <"$model" >"$model.sha256"
    XDG_DATA_HOME=$work/out run_script
    expect "the default place: below XDG_DATA_HOME" says "$model is already there"
}

test_the_registry_is_asked_where_there_is_no_npm() {
    set_up
    local only_path NPM_CONFIG_REGISTRY
    remove_npm
    run_script --output "$model"
    expect "no npm: exit code 1" exits_with 1
    expect "no npm: asks for a network" says "is there a network?"
    expect "no npm: says what went wrong" says "Connection refused"
    expect "no npm: leaves nothing behind" is_empty "$work/out"
}

test_npm_without_a_network_is_explained() {
    set_up
    fake_npm 'echo "npm error code EAI_AGAIN" >&2; exit 1'
    run_script --output "$model"
    expect "no network: exit code 1" exits_with 1
    expect "no network: asks for it" says "is there a network?"
    expect "no network: quotes npm" says "EAI_AGAIN"
    expect "no network: leaves nothing behind" is_empty "$work/out"
}

test_arguments() {
    set_up
    run_script --help
    expect "--help: exit code 0" exits_with 0
    expect "--help: names the licence" says "Apache-2.0"
    run_script --outptu "$model"
    expect "unknown argument: exit code 2" exits_with 2
    expect "unknown argument: named" says "'--outptu'"
    run_script --output
    expect "--output without a name: exit code 2" exits_with 2
    run_script --output "$work/out"
    expect "--output of a folder: exit code 1" exits_with 1
    expect "arguments: npm is not called" npm_was_not_called
}

test_a_wrong_package_is_refused
test_an_intact_file_is_kept
test_a_damaged_file_is_fetched_again_and_kept_until_then
test_the_default_place_follows_xdg
test_the_registry_is_asked_where_there_is_no_npm
test_npm_without_a_network_is_explained
test_arguments
end_of_tests
