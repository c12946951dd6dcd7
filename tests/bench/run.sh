#!/usr/bin/env bash
# Measures how fast everything is, each figure beside the plain form of the same work in the same
# run, and says which bars are met. docs/speed.md explains every key.
#
#   tests/bench/run.sh [--quick] [--json FILE]
#
# --quick      under three minutes instead of under fifteen: fewer streams and half widths, shorter
# --json FILE  write the figures there (default build/bench/figures.json)
#
# Charts are written into build/bench. The first run takes longer: it builds, and simulates a game.
# Exits with 1 when something could not be measured; a bar that is missed is said, not an error.
set -euo pipefail
json=
quick=false

usage() { # EXIT_CODE
  sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d'
  exit "$1"
}

while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=true && shift ;;
    --json) json=$(realpath -m -- "${2:?--json takes a file}") && shift 2 ;;
    -h | --help) usage 0 ;;
    *)
      echo "run.sh: unknown option $1" >&2
      usage 2
      ;;
  esac
done
CDPATH='' cd "$(dirname "$0")/../.."

tools/build.sh puck_bench
bin=build/release/bin
out=build/bench
mkdir -p "$out"
rm -f "$out"/*.json "$out"/*.png
json=${json:-$out/figures.json}
if [ -z "${PUCK_RECORDINGS-}" ] && [ -d ../shared/recordings ]; then
  PUCK_RECORDINGS=$(realpath ../shared/recordings)
  export PUCK_RECORDINGS
fi

# The repetitions of all benchmarks are shuffled, so that what disturbs the machine for a while
# disturbs a figure and its base alike.
flags=(
  --benchmark_repetitions=7 --benchmark_enable_random_interleaving=true
  --benchmark_report_aggregates_only=true
  --benchmark_out="$out/benchmarks.json" --benchmark_out_format=json
)
live_flags=(--json "$out/live.json")
if $quick; then
  flags+=(--benchmark_min_time=0.04
    --benchmark_filter='-eros_k[12468]_|_driving/|_sparklers/|_uniform/plain|_(300|3000)kev/')
  live_flags+=(--quick)
else
  flags+=(--benchmark_min_time=0.1)
fi

seconds() { # COMMAND...: runs it and says how long it took
  local begin=$SECONDS code=0
  "$@" || code=$?
  echo "  took $((SECONDS - begin)) s"
  return "$code"
}

failed=0
echo "measuring single steps"
seconds "$bin/puck-bench" "${flags[@]}" >"$out/puck-bench.txt" 2>"$out/puck-bench.log" || {
  tail -n 15 "$out/puck-bench.log" >&2
  echo "run.sh: puck-bench failed" >&2
  exit 1
}
tail -n 1 "$out/puck-bench.txt"
report_flags=(--json "$json")
echo "measuring the services"
if seconds "$bin/puck-bench-live" "${live_flags[@]}"; then
  report_flags+=(--live "$out/live.json")
else
  echo "run.sh: puck-bench-live failed" >&2
  failed=1
fi

echo
"$bin/puck-bench-report" "$out/benchmarks.json" "${report_flags[@]}" || failed=1
"$bin/charts/bench.py" "$json" "$out" || failed=1
echo
echo "figures in $json, charts in $out/"
exit "$failed"
