# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034,SC2154
# Sourced by the tests of the scripts that fetch packages, which name one in `script`: npm is replaced by
# a script of ours, so that no network is needed.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# fake_npm BODY: an npm that notes that it was called and runs BODY in the folder it is called in.
fake_npm() {
    printf '#!/bin/bash\ntouch "%s/npm-was-called"\n%s\n' "$work" "$1" >"$work/bin/npm"
    chmod +x "$work/bin/npm"
}

# A fresh, empty output folder and a PATH that begins with the fake npm.
set_up() {
    rm -rf "${work:?}"/*
    mkdir "$work/bin" "$work/out" "$work/tmp"
    fake_npm 'exit 1'
}

# remove_npm: sets only_path to a folder of tools without npm, and a registry that is not there.
remove_npm() {
    rm "$work/bin/npm"
    export NPM_CONFIG_REGISTRY=http://localhost:9
    local tool
    for tool in basename cat cut dirname mkdir mktemp rm sha256sum tr; do
        ln -s "$(command -v "$tool")" "$work/bin/$tool"
    done
    only_path=$work/bin
}

# run_script ARGUMENTS...: sets code and text (both streams).
run_script() {
    code=0
    text=$(PATH=${only_path:-$work/bin:$PATH} TMPDIR=$work/tmp "$BASH" "$script" "$@" 2>&1) || code=$?
}

# expect WHAT COMMAND...: the command must succeed.
expect() {
    local what=$1
    shift
    if "$@"; then
        echo "ok: $what"
    else
        echo "FAILED: $what; exit code $code, output: $text"
        failures=$((failures + 1))
    fi
}

says() { [[ $text == *"$1"* ]]; }
exits_with() { [[ $code == "$1" ]]; }
is_empty() { [[ -z $(ls -A "$1") ]]; }
npm_was_called() { [[ -e $work/npm-was-called ]]; }
npm_was_not_called() { ! npm_was_called; }

end_of_tests() {
    ((failures == 0)) && return
    echo "$failures checks failed"
    exit 1
}
