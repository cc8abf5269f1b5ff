#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Of all apps that were built, none but loop-closure-graphslam loads wxWidgets, directly or through
# another library.
set -euo pipefail

if [ $# -ne 1 ]; then
  echo "Usage: no_wxwidgets_test.sh APPS_FOLDER" >&2
  exit 2
fi

checked=0
for folder in "$1"/*/; do
  name=$(basename "$folder")
  app=$folder$name
  if [ ! -x "$app" ] || [ "$name" = loop-closure-graphslam ]; then continue; fi
  libraries=$(ldd "$app")
  if grep -i 'libwx' <<< "$libraries"; then
    echo "no_wxwidgets_test.sh: $name loads wxWidgets" >&2
    exit 1
  fi
  checked=$((checked + 1))
done
if [ "$checked" -lt 4 ]; then
  echo "no_wxwidgets_test.sh: $checked apps in $1; are they built?" >&2
  exit 1
fi
