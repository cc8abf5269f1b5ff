# SPDX-License-Identifier: BSD-3-Clause
# Sourced by get-model.sh and get-charts.sh: packages of npm whose content is known beforehand.
# shellcheck shell=bash

python=/usr/bin/python3 # Debian's: it sees the packages that apt installs

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

# download URL FILE
download() {
    "$python" - "$@" <<'EOF'
import shutil, sys, urllib.request
try:
    with urllib.request.urlopen(sys.argv[1], timeout=60) as page, open(sys.argv[2], "wb") as file:
        shutil.copyfileobj(page, file)
except OSError as error:
    sys.exit(str(error))
EOF
}

# fetch_tarball NAME VERSION FOLDER: with npm, where it is installed, for it knows of proxies and mirrors; else
# from the registry itself.
fetch_tarball() {
    local name=$1 version=$2 folder=$3 errors=$3/fetch.err
    if command -v npm >/dev/null; then
        (cd "$folder" && npm pack --loglevel=error "$name@$version" >npm.out 2>"$errors") && return
    else
        local url=${NPM_CONFIG_REGISTRY:-https://registry.npmjs.org}
        download "${url%/}/$name/-/${name##*/}-$version.tgz" "$folder/package.tgz" 2>"$errors" && return
    fi
    fail "cannot fetch $name $version; is there a network? $(tr -s '\n' ' ' <"$errors" | cut -c 1-200)"
}

# fetch_package NAME VERSION SHA512 FOLDER FILE...: leaves the FILEs of the package below FOLDER.
fetch_package() {
    local sha512=$3 folder=$4
    echo "fetching $1 $2"
    fetch_tarball "$1" "$2" "$folder"
    local tarballs=("$folder"/*.tgz)
    [[ -f ${tarballs[0]} ]] || fail "npm pack wrote no package; try again, or look at: npm pack $1@$2"
    check_sum sha512sum "${tarballs[0]}" "$sha512" "the package"
    tar -xzf "${tarballs[0]}" -C "$folder" "${@:5}"
}
