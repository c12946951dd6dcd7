#!/usr/bin/env bash
# Builds the fuzzers and lets them look for bytes that break what reads bytes.
#
#   tests/fuzz/run.sh [--minutes N [FUZZER...]]
#
# Without options: the corpus and a minute of smoke in all, as tests/run.sh deep does it. --minutes: so
# long for each of the fuzzers named (fuzz_messages, …), else for each of them all; what they learn
# stays in build/asan/corpus. Exit status 1 when something was found; the input is then in
# build/asan/findings.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/../.."

usage() {
  echo "usage: tests/fuzz/run.sh [--minutes N [FUZZER...]]" >&2
  exit 2
}

minutes=0
if [ $# -gt 0 ]; then
  [ "$1" = --minutes ] && [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
  minutes=$2
  shift 2
fi

cores=$(nproc)
tools/build.sh --preset asan puck_fuzzers

build=build/asan
fuzzers=("$@")
if [ ${#fuzzers[@]} -eq 0 ]; then
  for program in "$build"/bin/fuzz_*; do fuzzers+=("$(basename "$program")"); done
fi
for fuzzer in "${fuzzers[@]}"; do
  [ -x "$build/bin/$fuzzer" ] || usage
done
seconds=$((minutes > 0 ? 60 * minutes : 60 / ${#fuzzers[@]}))

scratch=$(mktemp -d)
stop_all() {
  local running
  running=$(jobs -rp)
  [ -z "$running" ] || kill $running
  wait
  rm -rf "$scratch"
}
trap stop_all EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
mkdir -p "$build/findings"
"$build/bin/puck-fuzz-seeds" . "$scratch/seeds"

fuzz() { # FUZZER; takes the place of the shell that calls it
  local learned=$scratch/learned/$1
  [ "$minutes" -eq 0 ] || learned=$build/corpus/$1
  mkdir -p "$learned"
  local known=() folder
  for folder in "$scratch/seeds/$1" "tests/fuzz/corpus/$1"; do
    [ ! -d "$folder" ] || known+=("$folder")
  done
  # A small quarantine: inputs come and go by the thousand in a second.
  ASAN_OPTIONS=quarantine_size_mb=16 exec nice "$build/bin/$1" -max_total_time="$seconds" \
    -max_len=4096 -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=128 -print_final_stats=1 \
    -artifact_prefix="$build/findings/$1-" "$learned" "${known[@]}" >"$scratch/$1.log" 2>&1
}

processes=()
# As many at once as there are cores.
for fuzzer in "${fuzzers[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$cores" ]; do sleep 0.1; done
  fuzz "$fuzzer" &
  processes+=($!)
done

printf '%-22s %12s %10s %10s  %s\n' fuzzer inputs inputs/s coverage findings
total=0
failed=0
for i in "${!fuzzers[@]}"; do
  fuzzer=${fuzzers[$i]}
  log=$scratch/$fuzzer.log
  found=none
  wait "${processes[$i]}" || {
    found=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
    found=${found:-failed}
    failed=1
  }
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  coverage=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
  printf '%-22s %12s %10s %10s  %s\n' "$fuzzer" "${inputs:-?}" "${rate:-?}" "${coverage:-?}" "$found"
  total=$((total + ${inputs:-0}))
  if [ "$found" != none ]; then grep -E '^(does not hold|==|SUMMARY|    #[0-9] )|runtime error' "$log" | head -n 30; fi
done
printf '%-22s %12s\n' total "$total"
exit "$failed"
