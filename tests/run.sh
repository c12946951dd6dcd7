#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#
#   tests/run.sh [unit|system|containers|all]
#
# unit: every library and service, optimised; again under AddressSanitizer with
# UndefinedBehaviorSanitizer; those that run threads under ThreadSanitizer; and a minute of fuzzing.
# system: the real programs together, over LCM on this machine. containers: the services as machines,
# where there is Docker. all, the default: everything.
set -euo pipefail
cd "$(dirname "$0")/.."

what=${1:-all}
case "$what" in
  unit | system | containers | all) ;;
  *)
    echo "usage: tests/run.sh [unit|system|containers|all]" >&2
    exit 2
    ;;
esac
jobs=$(nproc)

build() { # PRESET [TARGET...]
  local preset=$1
  shift
  echo "== building $preset"
  cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" -j "$jobs" ${1:+--target "$@"} -- --quiet
}

run() { # PRESET LABEL
  echo "== testing $1: $2"
  ctest --preset "$1" -L "^$2\$" -j "$jobs" --progress
}

tools/install-deps.sh

build release
if [ "$what" = unit ] || [ "$what" = all ]; then
  run release unit
  build asan puck_unit_tests puck_fuzzers
  run asan unit
  build tsan puck_thread_tests
  run tsan threads
  echo "== fuzzing"
  tests/fuzz/run.sh
fi
if [ "$what" = system ] || [ "$what" = all ]; then
  run release system
fi
if [ "$what" = containers ] || [ "$what" = all ]; then
  if docker info >/dev/null 2>&1; then
    echo "== testing containers"
    tests/containers/run.sh
  else
    echo "== containers: skipped, as there is no Docker that runs here"
  fi
fi
