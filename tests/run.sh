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
CDPATH='' cd "$(dirname "$0")/.."

what=${1:-all}
case "$what" in
  unit | system | containers | all) ;;
  *)
    echo "usage: tests/run.sh [unit|system|containers|all]" >&2
    exit 2
    ;;
esac
jobs=$(nproc)

wants() { # PART
  [ "$what" = "$1" ] || [ "$what" = all ]
}

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

# The containers' base image waits for network and disk more than for a processor, so it is made
# beside the builds. As for tests/containers/run.sh: one that was not there before is not there
# afterwards.
base=$(docker/base-image.sh --name)
base_log=build/base-image.log
base_maker=
begin_base_image() {
  if docker image inspect "$base" >/dev/null 2>&1; then return; fi
  mkdir -p "$(dirname "$base_log")"
  trap remove_base_image EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM
  # A process group of its own, to be ended as a whole.
  setsid nice docker/base-image.sh >"$base_log" 2>&1 &
  base_maker=$!
}
await_base_image() {
  [ -n "$base_maker" ] || return 0
  # What did not work beside the builds, tests/containers/run.sh tries again.
  wait "$base_maker" || true
  base_maker=
  cat "$base_log"
}
remove_base_image() {
  if [ -n "$base_maker" ]; then
    kill -- "-$base_maker" 2>/dev/null || true
    wait "$base_maker" || true
  fi
  docker image rm "$base" >/dev/null 2>&1 || true
}

tools/install-deps.sh

containers=false
if wants containers; then
  if docker info >/dev/null 2>&1; then
    containers=true
    begin_base_image
  fi
fi

build release
if wants unit; then
  run release unit
  build asan puck_unit_tests puck_fuzzers
  run asan unit
  build tsan puck_thread_tests
  run tsan threads
  echo "== fuzzing"
  tests/fuzz/run.sh
fi
if wants system; then
  run release system
fi
if $containers; then
  echo "== testing containers"
  await_base_image
  tests/containers/run.sh
elif wants containers; then
  echo "== containers: skipped, as there is no Docker that runs here"
fi
