#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian packages of mrpt-fild: the one list, which demo.sh and tests/run.sh share.
set -euo pipefail

usage="Usage: install-deps.sh [--tests]
Installs the Debian 12 packages that mrpt-fild needs to build and run; with --tests also those that
only its tests need. Asks for sudo when not root, and for nothing when all are there."

# Named one by one: libmrpt-dev would bring wxWidgets along.
packages=(
  g++ cmake ninja-build                 # to build
  libmrpt-common-dev libmrpt-config-dev libmrpt-img-dev libmrpt-io-dev libmrpt-obs-dev
  libmrpt-maps-dev libmrpt-opengl-dev libmrpt-poses-dev libmrpt-serialization-dev
  libmrpt-system-dev libmrpt-tclap-dev
  libosmesa6-dev                        # off-screen drawing
  libceres-dev                          # pose graph optimisation
  libopencv-dev                         # images, fundamental matrix, networks that oneDNN does not run
  libdnnl-dev                           # network inference
  libhnswlib-dev                        # proximity graph
  libeigen3-dev                         # whitening of descriptors, poses, alignment of trajectories
  libmatio-dev                          # ground truth in MATLAB files
  nlohmann-json3-dev                    # summary.json
  libssl-dev                            # checksum of the model
  zlib1g-dev                            # gzipped rawlogs
  ca-certificates python3 python3-numpy python3-onnx python3-flatbuffers   # get-model.sh, get-charts.sh
)
test_packages=(
  libgtest-dev libgmock-dev             # unit tests
  mrpt-apps mrpt-common                 # rawlog-edit, graph-slam, rawlogs nobody here wrote
  libmrpt-graphs-dev                    # reads our pose graphs back
  libmrpt-graphslam-dev                 # -DFILD_BUILD_GRAPHSLAM=ON; only here: brings wxWidgets along
  python3-opencv                        # checks the converted model, draws runs
  chromium chromium-driver python3-selenium   # looks at reports
  clang-format clang-tidy clang-tools   # formatting and lint
  g++-aarch64-linux-gnu                 # compiles for arm64
)

case "${1:-}" in
  "") ;;
  --tests) packages+=("${test_packages[@]}") ;;
  --help | -h) echo "$usage"; exit 0 ;;
  *) echo "install-deps.sh: unknown option '$1'" >&2; echo "$usage" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null | grep -qx installed ||
    missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install-deps.sh: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || {
    echo "install-deps.sh: run me as root, or install sudo; missing: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "install-deps.sh: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
