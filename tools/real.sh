#!/usr/bin/env bash
# Tests every preset and algorithm on recordings from outside our own simulator: a real ball, a real ellipse,
# real scenes without a disc, and another project's simulator.
#
#   tools/real.sh [--json FILE] [--only NAME[,NAME...]] [--recordings DIR] [--output DIR] [--jobs J]
#                 [--programs DIR]
#
# --json FILE        every run's figures, by the keys of puck-evaluate and `recording`, `contestant`
# --only NAMES       these presets and algorithms only
# --recordings DIR   folder of the recordings (default: PUCK_RECORDINGS, else ../shared/recordings).
#                    Missing recordings are named and left out
# --output DIR       for calibrations, figures and logs (default build/real)
# --jobs J           runs at a time (default: one a core)
# --programs DIR     use these programs and build nothing
#
# The puck's size is calibrated as a user would do it: by puck-calibrate on every 97th row of the truth, or on
# all of fewer than 1,000. The ellipse's size and lean are set by hand; the ball is tracked once more with a
# size of 14 px everywhere. On a recording without a disc, the tracker looks for pucks of 16, 32 and 48 px and
# of the simulated table's sizes, and a row is the mean of these four runs. Exit code 1: a run failed; its row
# is left out.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)
# shellcheck source=tools/games.sh
. "$root/tools/games.sh"

all="default evidence correlation paper reference cluster particle-filter particle-filter-eros"
read -ra contestants <<<"$all"
only=
json=
recordings=${PUCK_RECORDINGS:-$root/../shared/recordings}
output=$root/build/real
jobs=$(nproc)
programs=
while [ $# -gt 0 ]; do
  case "$1" in
    --json | --only | --recordings | --output | --jobs | --programs)
      [ -n "${2-}" ] || refuse "$1 takes a value; --help says which"
      case "$1" in
        --json) json=$(realpath -m "$2") ;;
        --only) only=$2 ;;
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
if [ -n "$only" ]; then
  mapfile -t contestants < <(tr , '\n' <<<"$only" | awk '!seen[$0]++')
  for name in "${contestants[@]}"; do
    case " $all " in *" $name "*) ;; *) refuse "--only takes some of: $all; got '$name'" ;; esac
  done
fi
require_jobs "$jobs"
[ -d "$recordings" ] ||
  refuse "no folder $recordings; set it with --recordings or PUCK_RECORDINGS"
recordings=$(realpath "$recordings")
require_programs puck-calibrate puck-evaluate
[ -z "$json" ] || : >>"$json" || refuse "$json cannot be written"
mkdir -p "$output"/runs "$output"/sizes
rm -f "$output"/runs/*.{json,part,log} "$output"/sizes/*.{toml,csv,log}

size_file() { # NAME WIDTH HEIGHT [LEAN_DEG]: a puck as large everywhere; prints the file's path
  local file=$output/sizes/$1.toml
  {
    printf '[size_model]\nwidth_0 = %s.0\nwidth_x = 0.0\nwidth_y = 0.0\n' "$2"
    printf 'height_0 = %s.0\nheight_x = 0.0\nheight_y = 0.0\n' "$3"
    if [ $# -gt 3 ]; then printf '[contour]\nlean_deg = %s.0\n' "$4"; fi
  } >"$file"
  echo "$file"
}

calibrated() { # NAME TRUTH WIDTH HEIGHT: prints the file's path
  local file=$output/sizes/$1.toml
  local marks=$output/sizes/$1.marks.csv
  awk -v rows="$(wc -l <"$2")" 'NR == 1 || rows <= 1000 || NR % 97 == 2' "$2" >"$marks"
  "$programs/puck-calibrate" size "$marks" --output "$file" --width "$3" --height "$4" \
    >"$output/sizes/$1.log" 2>&1 || refuse "$2 gives no size model: $(tail -n 1 "$output/sizes/$1.log")"
  echo "$file"
}

# A line per run: names of recording and run, and the options of puck-evaluate.
plan=()
missing=()
used=()

is_there() { # FILE: within the folder of recordings
  used+=("$1")
  [ -f "$recordings/$1" ] && return
  missing+=("$1")
  return 1
}

add() { # TITLE RUN OPTION...
  plan+=("$(printf '%s\t' "$@")")
}

ball=real_ball/bouncing_ball_atis_304x240
if is_there $ball.yarp.log && is_there $ball.truth.csv; then
  options=("$recordings/$ball.yarp.log" --width 304 --height 240 --truth "$recordings/$ball.truth.csv"
    --truth-gap-ms 150 --size-model)
  size=$(calibrated ball "$recordings/$ball.truth.csv" 304 240)
  add "real ball" ball "${options[@]}" "$size"
  add "real ball, at its marks" ball-marks "${options[@]}" "$size" --score-at-marks
  add "real ball, size 14 px everywhere" ball-14px "${options[@]}" "$(size_file ball-14px 14 14)"
fi

shapes=shapes_rotation_davis240c_240x180
if is_there $shapes.txt && is_there $shapes.truth.csv; then
  add "ellipse of shapes_rotation" ellipse "$recordings/$shapes.txt" --width 240 --height 180 \
    --truth "$recordings/$shapes.truth.csv" --size-model "$(size_file ellipse 33 23 -28)"
fi

for sequence in still_faint_6_m_s moving_faint_5_m_s moving_round_logos still_shots_15_m_s; do
  base=second_simulator/$sequence
  if is_there $base.raw && is_there $base.truth.csv; then
    size=$(calibrated $sequence "$recordings/$base.truth.csv" 640 480)
    add "second simulator: $sequence" $sequence "$recordings/$base.raw" \
      --truth "$recordings/$base.truth.csv" --size-model "$size"
  fi
done

sizes=("$(size_file puck16 16 12)" "$(size_file puck32 32 24)" "$(size_file puck48 48 36)"
  "$root/config/calibration/simulated_size.toml")
without_disc() { # TITLE FILE [OPTION of puck-evaluate...]
  is_there "$2" || return 0
  local size
  for size in "${sizes[@]}"; do
    add "no disc: $1" "$1-$(basename "$size" .toml)" "$recordings/$2" --no-puck \
      --size-model "$size" "${@:3}"
  done
}
without_disc dynamic_translation dynamic_translation_davis240c_240x180.txt --width 240 --height 180
without_disc driving driving_gen41_1280x720_evt3.raw
without_disc sparklers sparklers_gen31_640x480_evt2.raw
without_disc walking walking_640x480_evt3.extracted.raw --width 640 --height 480

if [ ${#plan[@]} -eq 0 ]; then refuse "none of the recordings is in $recordings"; fi

# The following also runs in the shells started by xargs.
export output programs

run() { # CONTESTANT LINE-OF-THE-PLAN
  set -euo pipefail
  local fields title name options
  IFS=$'\t' read -ra fields <<<"$2"
  title=${fields[0]}
  name=$output/runs/${fields[1]}-$1
  case "$1" in
    default | evidence | correlation | paper | reference) options=(--preset "$1") ;;
    *) options=(--algorithm "$1") ;;
  esac
  "$programs/puck-evaluate" "${fields[@]:2}" "${options[@]}" --json "$name.part" >/dev/null
  # Without its first line, the brace.
  { printf '{\n  "recording": "%s",\n  "run": "%s",\n  "contestant": "%s",\n' "$title" \
    "${fields[1]}" "$1" && tail -n +2 "$name.part"; } >"$name.json"
  rm "$name.part"
}
run_logged() { # LINE-OF-THE-PLAN CONTESTANT
  local name
  name=$(cut -f 2 <<<"$1")-$2
  logged "$name" "$output/runs/$name.log" run "$2" "$1"
}
export -f run run_logged

failed=0
for contestant in "${contestants[@]}"; do
  for line in "${plan[@]}"; do printf '%s\0%s\0' "$line" "$contestant"; done
done | xargs -0 -n 2 -P "$jobs" bash -c 'run_logged "$@"' run_logged || failed=1

# Prints the rows in the plan's order; several runs of a title are averaged.
print_rows() {
  local files=() file
  for file in "$output"/runs/*.json; do [ ! -f "$file" ] || files+=("$file"); done
  printf '%s\n' "${plan[@]%%$'\t'*}" | contestants=${contestants[*]} awk '
    FILENAME == "-" { if (!planned[$0]++) titles[++rows] = $0; next }
    function text_of(line) { sub(/^[^:]*: "/, "", line); sub(/",$/, "", line); return line }
    /^  "recording": / { title = text_of($0); next }
    /^  "contestant": / { row = title SUBSEP text_of($0); runs[row]++; next }
    {
      split($0, pair, /[":, ]+/)
      if (pair[3] ~ /^-?[0-9.]/) { sum[row, pair[2]] += pair[3]; count[row, pair[2]]++ }
    }
    function mean(key, decimals) {
      return count[row, key] ? sprintf("%." decimals "f", sum[row, key] / count[row, key]) : "–"
    }
    END {
      names = split(ENVIRON["contestants"], name, " ")
      for (i = 1; i <= rows; i++) for (k = 1; k <= names; k++) {
        row = titles[i] SUBSEP name[k]
        if (runs[row] < planned[titles[i]]) continue
        printf "| %s | %s | %s | %s | %s | %s | %s | %s |\n", titles[i], name[k],
          mean("mean_px", 2), mean("median_px", 2), mean("lost_percent", 2),
          mean("said_and_wrong_percent", 2), mean("time_to_first_track_ms", 0),
          mean("cpu_us_per_ms", 0)
      }
    }' - "${files[@]}"
}

echo
echo "| recording | tracker | mean px | median px | lost % | said and wrong % | first found, ms | CPU, µs/ms |"
echo "|---|---|---:|---:|---:|---:|---:|---:|"
print_rows

for file in "${missing[@]}"; do echo "$me: not in $recordings: $file" >&2; done
while IFS= read -r file; do
  case " ${used[*]} " in *" $file "*) ;; *) echo "$me: of a format that cannot be read yet: $file" >&2 ;; esac
done < <(cd "$recordings" && find . -maxdepth 1 -type f ! -name '*.md' ! -name '*.truth.csv' -printf '%P\n' | sort)

if [ -n "$json" ]; then
  {
    echo '['
    first=yes
    for file in "$output"/runs/*.json; do
      [ -f "$file" ] || continue
      [ -n "$first" ] || echo ','
      first=
      cat "$file"
    done
    echo ']'
  } >"$json"
  echo "figures of every run: $json" >&2
fi
exit "$failed"
