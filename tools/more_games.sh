#!/usr/bin/env bash
# Plays many games of one kind and prints the tracker's figures with the standard error of the mean. (Five
# games of ten seconds distinguish two trackers only if one is far better.)
#
#   tools/more_games.sh FIRST-LAST [--scene SCENE.toml] [--moving] [--seconds S] [--size-model FILE]
#                       [--jobs J] [--output DIR] [--programs DIR] [--keep] [-- OPTION...]
#
# FIRST-LAST         seeds of the games. 1 to 99 are for development
# --scene SCENE      scene file (default: the plain game), as in tools/compare/scenes
# --moving           with a camera that turns
# --seconds S        length of each (default 10)
# --size-model FILE  the puck's (default config/calibration/simulated_size.toml)
# --jobs J           games at a time (default: one a core)
# --output DIR       for figures, logs and temporary recordings (default
#                    build/more_games)
# --programs DIR     use these programs and build nothing
# --keep             keep the recordings (30 to 100 MB each); later runs with the same scene,
#                    length and simulator use them, too
# -- OPTION...       tracks each game once more with these options of puck-evaluate, such as
#                    --search-delay 5000 or --preset correlation, and prints the change
#
# Prints a row for each game, mean px / lost % / longest loss in ms, and then the means. Exit code 1: a game
# could not be played or scored; it is left out of rows and means.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)
# shellcheck source=tools/games.sh
. "$root/tools/games.sh"

seeds=
scene=
moving=
seconds=10
size_model=$root/config/calibration/simulated_size.toml
jobs=$(nproc)
output=$root/build/more_games
programs=
keep=
options=()
while [ $# -gt 0 ]; do
  case "$1" in
    --scene) scene=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    --moving) moving=--moving && shift ;;
    --seconds) seconds=${2-} && shift 2 || usage 2 ;;
    --size-model) size_model=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    --jobs) jobs=${2-} && shift 2 || usage 2 ;;
    --output) output=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    --programs) programs=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
    --keep) keep=yes && shift ;;
    --)
      shift
      options=("$@")
      [ -n "${*}" ] || refuse "-- takes options of puck-evaluate, got none"
      break
      ;;
    -h | --help) usage 0 ;;
    -*) refuse "unknown option $1; --help lists them" ;;
    *)
      [ -z "$seeds" ] || refuse "takes one range of seeds, got $seeds and $1"
      seeds=$1
      shift
      ;;
  esac
done
[[ $seeds =~ ^([0-9]{1,9})-([0-9]{1,9})$ ]] || refuse "takes a range of seeds as 11-40, got '$seeds'"
first=$((10#${BASH_REMATCH[1]}))
last=$((10#${BASH_REMATCH[2]}))
[ "$first" -le "$last" ] || refuse "takes a range of seeds, the smaller one first, got $seeds"
require_seconds "$seconds"
require_jobs "$jobs"
[ -z "$scene" ] || [ -f "$scene" ] || refuse "no scene $scene"
[ -f "$size_model" ] || refuse "no size model $size_model"
require_programs puck-simulate puck-evaluate

kind=$(cat "$programs/puck-simulate" ${scene:+"$scene"} | sha256sum | cut -c 1-12)
games=$output/${scene:+$(basename "$scene" .toml)-}${moving:+moving-}${seconds}s-$kind

# The following also runs in the shells started by xargs.
export scene moving seconds size_model programs keep games

# Writes the game's figures: with default, and with the options, if given.
game() { # SEED [OPTION...]
  set -euo pipefail
  # Not local: the trap runs after this function.
  recording=$games/$1
  if [ ! -f "$recording.complete" ]; then
    trap 'rm -f "$recording".{complete,raw,truth.csv,annotations.csv,toml}' EXIT
    "$programs/puck-simulate" ${scene:+--scene "$scene"} --seed "$1" --seconds "$seconds" \
      ${moving:+"$moving"} --output "$recording" >&2
    touch "$recording.complete"
    [ -z "$keep" ] || trap - EXIT
  fi
  local figures
  figures=$(score "$recording" "$size_model")
  if [ $# -gt 1 ]; then figures+=" $(score "$recording" "$size_model" "${@:2}")"; fi
  echo "$1 $figures" >"$recording.figures"
}

game_logged() { # [OPTION...] SEED
  local seed=${*: -1}
  logged "seed $seed" "$games/$seed.log" game "$seed" "${@:1:$#-1}"
}
export -f game game_logged

mkdir -p "$games"
exec 9>"$games/lock"
flock --nonblock 9 || refuse "another run works in $games; --output DIR gives this one a folder of its own"
rm -f "$games"/*.figures
failed=0
seq "$first" "$last" |
  xargs -n 1 -P "$jobs" bash -c 'game_logged "$@"' game_logged "${options[@]}" || failed=1

which="$seconds s, $(basename "${scene:-plain}" .toml)${moving:+, moving}"
for seed in $(seq "$first" "$last"); do
  if [ -f "$games/$seed.figures" ]; then cat "$games/$seed.figures"; fi
done | extra=${options[*]} which=$which awk '
  function note(name, value) { sum[name] += value; square[name] += value * value }
  function mean(name) { return sum[name] / NR }
  function error(name,   variance) {
    if (NR < 2) return "?"
    variance = (square[name] - NR * mean(name) ^ 2) / (NR - 1)
    return sprintf("%.3f", sqrt((variance > 0 ? variance : 0) / NR))
  }
  function means(sign, px, lost) {
    return sprintf("%" sign ".3f ± %s / %" sign ".3f ± %s", mean(px), error(px), mean(lost),
                   error(lost))
  }
  BEGIN {
    options = ENVIRON["extra"]
    gsub(/[|]/, "/", options)
    print options == "" ? "| seed | default |" : "| seed | default | " options " |"
    print options == "" ? "|---:|---:|" : "|---:|---:|---:|"
  }
  {
    printf "| %d | %.3f / %.3f / %.0f |", $1, $2, $3, $4
    note("px", $2); note("lost", $3)
    if ($4 > longest) longest = $4
    if (options != "") {
      printf " %.3f / %.3f / %.0f |", $5, $6, $7
      note("px2", $5); note("lost2", $6); note("more_px", $5 - $2); note("more_lost", $6 - $3)
      if ($7 > longest2) longest2 = $7
    }
    print ""
  }
  END {
    if (NR == 0) exit
    printf "\n%d %s of %s, mean px / lost %%:\n", NR, NR == 1 ? "game" : "games", ENVIRON["which"]
    printf "default: %s, longest loss %.0f ms\n", means("", "px", "lost"), longest
    if (options == "") exit
    printf "%s: %s, longest loss %.0f ms\n", options, means("", "px2", "lost2"), longest2
    printf "change: %s\n", means("+", "more_px", "more_lost")
  }'
exit "$failed"
