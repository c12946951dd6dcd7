#!/usr/bin/env bash
# Fits what preset `default` has learned of pucks (puck-calibrate evidence) to games of our simulator, the
# second simulator and the real ball: once to all, and once without each recording, so that
# `tools/real.sh --evidence DIR` tests every recording with numbers that were fitted without it.
#
#   tools/fit_evidence.sh [--recordings DIR] [--output DIR] [--jobs J] [--programs DIR]
#
# --recordings DIR   folder of the recordings (default: PUCK_RECORDINGS, else ../shared/recordings)
# --output DIR       for games, size models and fits (default build/evidence)
# --jobs J           games or fits at a time (default: one a core)
# --programs DIR     use these programs and build nothing
#
# Writes all.toml and without-RECORDING.toml into DIR. Each recording weighs the same, the ball three times as
# much. In the games of round logos there are things that look exactly like the puck: only the puck is learned
# from them. Takes about 15 minutes on two cores. Exit code 1: a game or a fit failed.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)
# shellcheck source=tools/games.sh
. "$root/tools/games.sh"

recordings=${PUCK_RECORDINGS:-$root/../shared/recordings}
output=$root/build/evidence
jobs=$(nproc)
programs=
while [ $# -gt 0 ]; do
  case "$1" in
    --recordings | --output | --jobs | --programs)
      [ -n "${2-}" ] || refuse "$1 takes a value; --help says which"
      case "$1" in
        --recordings) recordings=$2 ;;
        --output) output=$(realpath -m "$2") ;;
        --jobs) jobs=$2 ;;
        --programs) programs=$(realpath -m "$2") ;;
      esac
      shift 2
      ;;
    -h | --help) usage 0 ;;
    *) refuse "unknown option $1; --help lists them" ;;
  esac
done
require_jobs "$jobs"
[ -d "$recordings" ] ||
  refuse "no folder $recordings; set it with --recordings or PUCK_RECORDINGS"
recordings=$(realpath "$recordings")
require_programs puck-simulate puck-calibrate
mkdir -p "$output"
export output programs root recordings

# Name, seed, scene or -, and --moving or nothing.
games="still 41 -
moving 42 - --moving
low-contrast 43 low_contrast_6_m_s
low-contrast-moving 44 low_contrast_5_m_s --moving
fast 45 fast_shots
fast-moving 46 fast_shots --moving
flicker 47 flicker
rests 48 rests
occlusion 49 occlusion
goals 50 goals
leaves-image 51 leaves_image --moving
noisy 52 noisy_sensor
logos 53 round_logos --moving"
second="still_faint_6_m_s moving_faint_5_m_s moving_round_logos still_shots_15_m_s"
ball=real_ball/bouncing_ball_atis_304x240
export games second ball
files=("$ball.yarp.log" "$ball.truth.csv")
for name in $second; do files+=("second_simulator/$name.raw" "second_simulator/$name.truth.csv"); done
for file in "${files[@]}"; do
  [ -f "$recordings/$file" ] || refuse "not in $recordings: $file"
done

play() { # NAME SEED SCENE [--moving]
  set -euo pipefail
  local scene=()
  [ "$3" = - ] || scene=(--scene "$root/tools/compare/scenes/$3.toml")
  "$programs/puck-simulate" "${scene[@]}" --seed "$2" --seconds 10 "${@:4}" --output "$output/$1" >&2
}

size() { # NAME WIDTH HEIGHT
  set -euo pipefail
  local truth=$recordings/second_simulator/$1.truth.csv
  [ "$1" != ball ] || truth=$recordings/$ball.truth.csv
  calibrate_size "$truth" "$2" "$3" "$output/$1.size"
}

fit() { # FIT: all, or without-RECORDING
  set -euo pipefail
  local name files=() truths=() sizes=() gaps=() weights=() lookalikes=()
  add() { # NAME FILE TRUTH SIZE GAP_MS WEIGHT
    [ "$1" != "${fit#without-}" ] || return 0
    files+=("$2") truths+=("$3") sizes+=("$4") gaps+=("$5") weights+=("$6")
    case "$1" in *logos) lookalikes+=("$2") ;; esac
  }
  local fit=$1
  while read -r name _; do
    add "$name" "$output/$name.raw" "$output/$name.truth.csv" \
      "$root/config/calibration/simulated_size.toml" 10 1
  done <<<"$games"
  for name in $second; do
    local base=$recordings/second_simulator/$name
    add "$name" "$base.raw" "$base.truth.csv" "$output/$name.size.toml" 10 1
  done
  add ball "$recordings/$ball.yarp.log" "$recordings/$ball.truth.csv" "$output/ball.size.toml" 150 3
  "$programs/puck-calibrate" evidence "${files[@]}" --truth "${truths[@]}" --size-model "${sizes[@]}" \
    --truth-gap-ms "${gaps[@]}" --weight "${weights[@]}" --lookalikes "${lookalikes[@]}" \
    --output "$output/$fit.toml" >&2
}
export -f play size fit

run_each() { # FUNCTION: its words, in a line of standard input each
  xargs -d '\n' -n 1 -P "$jobs" bash -c \
    'read -ra words <<<"$2"; logged "${words[0]}" "$output/${words[0]}.log" "$1" "${words[@]}"' run_each "$1" ||
    {
      echo "$me: the lines above say what failed" >&2
      exit 1
    }
}

rm -f "$output"/*.toml
run_each play <<<"$games"
{
  echo "ball 304 240"
  for name in $second; do echo "$name 640 480"; done
} | run_each size
{
  echo all
  for name in ball $second; do echo "without-$name"; done
} | run_each fit
echo "fits are in $output"
