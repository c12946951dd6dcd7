#!/usr/bin/env bash
# Tests the tracker with other sensors, cameras, heads and pucks: games in scenes that differ from
# config/scene.toml in a few keys each. Only the puck's size and the sensor's lag are calibrated for each
# scene; no parameter changes.
#
#   tools/other_scenes.sh [--seconds S] [--jobs J] [--output DIR] [--programs DIR] [SCENE.toml...]
#
# SCENE.toml      these scenes (default: all in tools/compare/other_scenes). The comment in a
#                 scene's first line names its row
# --seconds S     length of each game (default 10); calibration always takes 10 s
# --jobs J        scenes at a time (default: one a core)
# --output DIR    for calibrations, rows and logs (default build/other_scenes)
# --programs DIR  use these programs and build nothing
#
# Prints mean px / lost % of two games with a still camera and of two with a moving one (development seeds 11
# and 12; calibration on seed 1). A scene with keys of [head] has no still games. Exit code 1: a scene could
# not be played or scored; it has no row. All scenes took 15 to 41 minutes of processor time.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)

# shellcheck source=tools/games.sh
. "$root/tools/games.sh"

seconds=10
jobs=$(nproc)
output=$root/build/other_scenes
programs=
scenes=()
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds=${2-} && shift 2 || usage 2 ;;
    --jobs) jobs=${2-} && shift 2 || usage 2 ;;
    --output) output=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    --programs) programs=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    -h | --help) usage 0 ;;
    -*) refuse "unknown option $1; --help lists them" ;;
    *)
      [ -f "$1" ] || refuse "no scene $1"
      scenes+=("$(realpath "$1")")
      shift
      ;;
  esac
done
require_seconds "$seconds"
require_jobs "$jobs"
if [ ${#scenes[@]} -eq 0 ]; then scenes=("$root"/tools/compare/other_scenes/*.toml); fi
twice=$(for scene in "${scenes[@]}"; do basename "$scene"; done | sort | uniq -d | head -n 1)
[ -z "$twice" ] || refuse "two scenes are called $twice; each needs a name of its own"

require_programs puck-simulate puck-calibrate puck-evaluate

# The following also runs in the shells started by xargs.
export seconds output programs

game_figures() { # SCENE FOLDER SEED [--moving]: "mean_px lost_percent longest_loss_ms"
  local game=$2/game
  "$programs/puck-simulate" --scene "$1" --seed "$3" --seconds "$seconds" --output "$game" \
    ${4:+"$4"} >&2
  score "$game" "$2/size.toml"
}

cell() { # SCENE FOLDER [--moving]: the mean of two games
  local first second
  first=$(game_figures "$1" "$2" 11 ${3:+"$3"})
  second=$(game_figures "$1" "$2" 12 ${3:+"$3"})
  printf '%s\n' "$first" "$second" |
    awk '{ px += $1; lost += $2 } END { printf "%.2f / %.2f", px / NR, lost / NR }'
}

# Writes the scene's row into the output folder.
row() { # SCENE
  set -euo pipefail
  shopt -s inherit_errexit
  local label still=– moving width height
  # Not local: the trap runs after this function.
  name=$(basename "$1" .toml)
  folder=$output/$name
  marks=$folder/marks
  mkdir -p "$folder"
  trap 'rm -f "$marks".* "$folder"/game.*' EXIT

  "$programs/puck-simulate" --scene "$1" --seed 1 --seconds 10 --output "$marks" >&2
  read -r width height < <(sed -n 's/^% geometry \([0-9]*\)x\([0-9]*\)$/\1 \2/p; /^% end/q' \
    "$marks.raw")
  "$programs/puck-calibrate" size "$marks.annotations.csv" --output "$folder/size.toml" \
    --width "$width" --height "$height" >&2
  "$programs/puck-calibrate" lag "$marks.raw" --truth "$marks.truth.csv" \
    --size-model "$folder/size.toml" --output "$folder/size.toml" >&2

  if ! grep -Eq '^[[:blank:]]*(\[head\]|head\.)' "$1"; then still=$(cell "$1" "$folder"); fi
  moving=$(cell "$1" "$folder" --moving)
  label=$(sed -n '1s/^#[[:blank:]]*\(.*[^.]\)\.*$/\1/p' "$1" | tr '|' '/')
  echo "| ${label:-$name} | $still | $moving |" >"$folder/row.md"
}

row_logged() { # SCENE
  local name
  name=$(basename "$1" .toml)
  rm -f "$output/$name/row.md"
  logged "$name" "$output/$name.log" row "$1"
}
export -f game_figures cell row row_logged

mkdir -p "$output"
failed=0
printf '%s\0' "${scenes[@]}" |
  xargs -0 -n 1 -P "$jobs" bash -c 'row_logged "$1"' row_logged || failed=1

echo "| mean px / lost % | still | moving |"
echo "|---|---:|---:|"
for scene in "${scenes[@]}"; do
  row_file=$output/$(basename "$scene" .toml)/row.md
  if [ -f "$row_file" ]; then cat "$row_file"; fi
done
exit "$failed"
