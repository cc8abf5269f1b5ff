# SPDX-License-Identifier: BSD-3-Clause
# Sourced by get-model.sh and get-charts.sh: packages of npm whose content is known beforehand.
# shellcheck shell=bash

fail() {
    echo "$(basename "$0"): error: $*" >&2
    exit 1
}

wrong_usage() {
    echo "$(basename "$0"): $*" >&2
    exit 2
}

# parse_arguments NAME WHAT ARGUMENT...: sets output, which is NAME beside the data of mrpt-fild unless --output
# gives another WHAT. Calls usage for --help.
parse_arguments() {
    output=${XDG_DATA_HOME:-$HOME/.local/share}/mrpt-fild/$1
    local what=$2
    shift 2
    while (($#)); do
        case $1 in
        --help)
            usage
            exit 0
            ;;
        --output)
            if (($# < 2)) || [[ -z $2 ]]; then wrong_usage "--output needs $what"; fi
            output=$2
            shift 2
            ;;
        *) wrong_usage "unknown argument '$1'; see --help" ;;
        esac
    done
}

# sum_of TOOL FILE: the bare checksum. Read from stdin, so that no file name is escaped into the line.
sum_of() {
    "$1" <"$2" | cut -d ' ' -f 1
}

# check_sum TOOL FILE EXPECTED WHAT
check_sum() {
    local got
    got=$(sum_of "$1" "$2")
    [[ $got == "$3" ]] || fail "$4 is not the one expected: ${1%sum} $got, expected $3; nothing was written"
}

check_npm() {
    command -v npm >/dev/null || fail "npm is not installed; try: apt install npm"
}

# fetch_package NAME VERSION SHA512 FOLDER FILE...: leaves the FILEs of the package below FOLDER.
fetch_package() {
    local package=$1@$2 sha512=$3 folder=$4
    echo "fetching $1 $2"
    if ! (cd "$folder" && npm pack --loglevel=error "$package" >npm.out 2>npm.err); then
        fail "npm could not fetch $package; is there a network? npm: $(tr -s '\n' ' ' <"$folder/npm.err" | cut -c 1-200)"
    fi
    local tarballs=("$folder"/*.tgz)
    [[ -f ${tarballs[0]} ]] || fail "npm pack wrote no package; try again, or look at: npm pack $package"
    check_sum sha512sum "${tarballs[0]}" "$sha512" "the package"
    tar -xzf "${tarballs[0]}" -C "$folder" "${@:5}"
}
