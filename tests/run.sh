#!/usr/bin/env bash
# Installs missing packages, builds, and runs the tests.
#
#   tests/run.sh [unit|system|containers|deep|all]
#
# Default: unit and system in one optimised build; at most 10 minutes on two cores, from nothing.
# unit        every library and service
# system      the real programs together, over LCM on this machine
# containers  the services in a container each; needs Docker
# deep        what takes longer: long games and benchmarks, AddressSanitizer with
#             UndefinedBehaviorSanitizer, ThreadSanitizer, a minute of fuzzing, containers, the page of
#             puck-view in Chromium
# all         the default and deep
#
# Prints a line a suite and a table of times; exits with 1 when a suite failed.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."

what=${1:-default}
case "$what" in
  default | unit | system | containers | deep | all) ;;
  *) what= ;;
esac
if [ -z "$what" ] || [ $# -gt 1 ]; then
  echo "usage: tests/run.sh [unit|system|containers|deep|all]" >&2
  exit 2
fi
wants() { # PART...: whether the command line asks for one of them
  [[ " $* " = *" $what "* ]]
}

if wants containers && ! docker info >/dev/null 2>&1; then
  echo "tests/run.sh: no Docker daemon answers; install docker.io and start it, or leave out 'containers'" >&2
  exit 1
fi
tools/install-deps.sh
mkdir -p build 2>/dev/null || {
  echo "tests/run.sh: cannot make $PWD/build; check its permissions and the space on the disk" >&2
  exit 1
}
needed_mb=700
if wants deep all; then needed_mb=4000; fi
free_mb=$(df -Pm build | awk 'NR == 2 { print $4 }')
[ "$free_mb" -ge "$needed_mb" ] || {
  echo "tests/run.sh: $free_mb MB are free in $PWD/build, and $needed_mb are needed; free some" >&2
  exit 1
}

jobs=$(nproc)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
failed=0

# A step of the run: tells its name, result and time, and keeps the line for the table.
step() { # NAME COMMAND...
  local name=$1 begin=$EPOCHREALTIME code=0 seconds
  shift
  "$@" || code=$?
  seconds=$(awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
  printf '%8s s  %s%s\n' "$seconds" "$name" "$([ $code = 0 ] || echo ', FAILED')" >>"$work/times"
  [ "$code" = 0 ] || failed=1
  return "$code"
}

build() { # PRESET TARGET...
  local preset=$1
  shift
  echo "building $preset"
  step "build $preset" tools/build.sh --preset "$preset" "$@" || {
    echo "tests/run.sh: the build of $preset failed" >&2
    exit 1
  }
}
# A line a suite while they run; what a failed one printed comes with it.
suites() { # PRESET LABEL
  local preset=$1 label=$2 code=0
  echo "testing $preset, $label"
  # One more than there are cores: many tests wait most of their time.
  ctest --preset "$preset" -L "^$label\$" -j "$((jobs + 1))" --output-junit "$work/junit.xml" |
    sed -nE -e 's/^ *([0-9]+\/[0-9]+) +Test +#[0-9]+: +(\S+) [ .]*(\**)(Passed|Failed|Timeout|\S.*\S) +([0-9.]+) sec.*/\1 \2 \4 \5 s/p' \
      -e t -e '/^ +Start |^Test project|^Label Time|^$|^(unit|system|deep|threads) +=/d' -e p || code=1
  sed -nE 's/.*<testcase name="([^"]*)".* time="([^"]*)" status="([^"]*)".*/\2 \1 \3/p' "$work/junit.xml" |
    while read -r seconds name status; do
      [ "$preset" = release ] || name="$name, $preset"
      printf '%8.1f s  %s%s\n' "$seconds" "$name" "$([ "$status" = run ] || echo ', FAILED')"
    done | sort -rn >>"$work/times"
  [ "$code" = 0 ] || failed=1
}

release_targets=()
if wants default all unit; then release_targets+=(puck_unit_tests); fi
if wants default all system; then release_targets+=(puck_system_tests); fi
if wants all deep; then release_targets+=(puck_deep_tests); fi
if wants all deep containers; then release_targets+=(puck_programs puck-container-verdict puck-intruder); fi
build release "${release_targets[@]}"
if wants default all unit; then suites release unit; fi
if wants default all system; then suites release system; fi
if wants all deep; then
  suites release deep
  build asan puck_unit_tests puck_fuzzers
  suites asan unit
  build tsan puck_thread_tests
  suites tsan threads
  step fuzzing tests/fuzz/run.sh || true
  step browser tests/browser/run.sh || true
fi
if wants all deep containers; then
  if docker info >/dev/null 2>&1; then
    step containers tests/containers/run.sh || true
  else
    echo "containers: skipped, no Docker daemon answers"
  fi
fi

echo
cat "$work/times"
printf '%8d s  in all\n' "$SECONDS"
if [ "$failed" != 0 ]; then
  echo "tests/run.sh: FAILED: $(sed -n 's/^.* s  \(.*\), FAILED$/\1/p' "$work/times" | paste -sd, | sed 's/,/, /g')" >&2
  exit 1
fi
echo "all passed"
