#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests what datasets-scripts/get-charts.sh does without a network: npm is replaced by a script of ours.
# CHARTS_DIR, the folder that the build takes its charts from, is an intact one.
set -euo pipefail

charts_dir=${1:?usage: get_charts_test.sh CHARTS_DIR}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
script=$here/../../datasets-scripts/get-charts.sh
source "$here/fake_npm.sh"

test_a_wrong_package_is_refused() {
    set_up
    fake_npm 'echo "not the package" >echarts-0.tgz'
    run_script --output "$work/out/charts"
    expect "a wrong package: exit code 1" exits_with 1
    expect "a wrong package: says what it expected" says "expected ab4c9a14"
    expect "a wrong package: leaves nothing behind" is_empty "$work/out"
    expect "a wrong package: leaves no temporary folder" is_empty "$work/tmp"
}

test_an_intact_folder_is_kept() {
    set_up
    run_script --output "$charts_dir"
    expect "an intact folder: exit code 0" exits_with 0
    expect "an intact folder: says so" says "already there and intact"
    expect "an intact folder: npm is not called" npm_was_not_called
}

test_a_damaged_folder_is_fetched_again() {
    set_up
    cp "$charts_dir"/{echarts.min.js,LICENSE,NOTICE} "$work/out"
    echo "damaged" >>"$work/out/NOTICE"
    run_script --output "$work/out"
    expect "a damaged folder: npm is called" npm_was_called
    expect "a damaged folder: a failure is reported" exits_with 1
    expect "a damaged folder: says which package" says "echarts 6.1.0"
}

test_the_registry_is_asked_where_there_is_no_npm() {
    set_up
    local only_path NPM_CONFIG_REGISTRY
    remove_npm
    run_script --output "$work/out/charts"
    expect "no npm: exit code 1" exits_with 1
    expect "no npm: asks for a network" says "is there a network?"
    expect "no npm: says what went wrong" says "Connection refused"
}

test_arguments() {
    set_up
    run_script --help
    expect "--help: exit code 0" exits_with 0
    expect "--help: names the licence" says "Apache-2.0"
    run_script --outptu "$work/out"
    expect "unknown argument: exit code 2" exits_with 2
    run_script --output
    expect "--output without a name: exit code 2" exits_with 2
    echo text >"$work/out/file"
    run_script --output "$work/out/file"
    expect "--output of a file: exit code 1" exits_with 1
    expect "arguments: npm is not called" npm_was_not_called
}

test_a_wrong_package_is_refused
test_an_intact_folder_is_kept
test_a_damaged_folder_is_fetched_again
test_the_registry_is_asked_where_there_is_no_npm
test_arguments
end_of_tests
