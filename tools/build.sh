#!/usr/bin/env bash
# Installs what is missing, and builds these targets into build/release, optimised.
#
#   tools/build.sh TARGET...
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."

tools/install-deps.sh
echo "building"
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)" --target "$@" -- --quiet
