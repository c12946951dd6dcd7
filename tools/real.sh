#!/usr/bin/env bash
# Tests every preset and algorithm on recordings from outside our own simulator: a real ball, a real ellipse,
# real scenes without a disc, and another project's simulator.
#
#   tools/real.sh [--json FILE] [--only NAME[,NAME...]] [--recordings DIR] [--output DIR] [--jobs J]
#                 [--programs DIR] [--evidence DIR] [--scale-decision NAME=FACTOR]
#
# --json FILE        every run's figures, by the keys of puck-evaluate and `recording`, `contestant`
# --only NAMES       these presets and algorithms only; PRESET-tos, -sits or -sae is a preset on another surface
#                    (correlation, paper, reference), which runs only if it is named
# --recordings DIR   folder of the recordings (default: PUCK_RECORDINGS, else ../shared/recordings).
#                    Missing recordings are named and left out
# --output DIR       for calibrations, figures and logs (default build/real)
# --jobs J           runs at a time (default: one a core)
# --programs DIR     use these programs and build nothing
# --evidence DIR     folder of tools/fit_evidence.sh: `default` uses the numbers of without-RECORDING.toml if
#                    it is there, else of all.toml; says which there are
# --scale-decision NAME=FACTOR
#                    `default` with a number of its decisions multiplied, to see what depends on it
#
# The puck's size is calibrated as a user would do it: by puck-calibrate on every 97th row of the truth, or on
# all of fewer than 1,000. The ellipse's size and lean are set by hand; the ball is tracked once more with a
# size of 14 px everywhere. On a recording without a disc, the tracker looks for pucks of 16, 32 and 48 px and
# of the simulated table's sizes, and a row is the mean of these four runs. Rows with wrong sizes are the
# mean of sizes × 0.6, 0.8, 1.25 and 1.6. The fast dots are simulated here: a disc of 14 px goes round in a
# circle of 100 px for 50 ms, and each pixel makes six events of an edge within 0.3, 1 or 2 ms on average; a
# row is the mean of these three. Exit code 1: a run failed; its row is left out.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)
# shellcheck source=tools/games.sh
. "$root/tools/games.sh"

all="default correlation paper reference cluster particle-filter particle-filter-eros"
read -ra contestants <<<"$all"
surfaces=$(printf '%s ' {correlation,paper,reference}-{tos,sits,sae})
only=
json=
recordings=${PUCK_RECORDINGS:-$root/../shared/recordings}
output=$root/build/real
jobs=$(nproc)
programs=
evidence=
scale=
while [ $# -gt 0 ]; do
  case "$1" in
    --json | --only | --recordings | --output | --jobs | --programs | --evidence | --scale-decision)
      [ -n "${2-}" ] || refuse "$1 takes a value; --help says which"
      case "$1" in
        --json) json=$(realpath -m "$2") ;;
        --only) only=$2 ;;
        --recordings) recordings=$2 ;;
        --output) output=$(realpath -m "$2") ;;
        --jobs) jobs=$2 ;;
        --programs) programs=$(realpath -m "$2") ;;
        --evidence) evidence=$(realpath -m "$2") ;;
        --scale-decision) scale=$2 ;;
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
    case " $all $surfaces" in *" $name "*) ;; *) refuse "--only takes some of: $all $surfaces; got '$name'" ;; esac
  done
fi
require_jobs "$jobs"
[ -d "$recordings" ] ||
  refuse "no folder $recordings; set it with --recordings or PUCK_RECORDINGS"
[ -z "$evidence" ] || [ -f "$evidence/all.toml" ] ||
  refuse "no fits in $evidence; tools/fit_evidence.sh makes them"
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

calibrated() { # NAME TRUTH WIDTH HEIGHT [FACTOR]: prints the size model's path
  local file=$output/sizes/$1
  calibrate_size "$2" "$3" "$4" "$file" "${@:5}" 2>"$file.log" ||
    refuse "$2 gives no size model: $(tail -n 1 "$file.log")"
  echo "$file.toml"
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

wrong_factors="0.6 0.8 1.25 1.6"

ball=real_ball/bouncing_ball_atis_304x240
if is_there $ball.yarp.log && is_there $ball.truth.csv; then
  options=("$recordings/$ball.yarp.log" --width 304 --height 240 --truth "$recordings/$ball.truth.csv"
    --truth-gap-ms 150 --size-model)
  size=$(calibrated ball "$recordings/$ball.truth.csv" 304 240)
  add "real ball" ball "${options[@]}" "$size"
  add "real ball, at its marks" ball-marks "${options[@]}" "$size" --score-at-marks
  add "real ball, size 14 px everywhere" ball-14px "${options[@]}" "$(size_file ball-14px 14 14)"
  for factor in $wrong_factors; do
    add "real ball, wrong sizes" "ball-times-$factor" "${options[@]}" \
      "$(calibrated "ball-times-$factor" "$recordings/$ball.truth.csv" 304 240 "$factor")"
  done
  add "real ball, size model of the simulated table" ball-table "${options[@]}" \
    "$root/config/calibration/simulated_size.toml"
fi

shapes=shapes_rotation_davis240c_240x180
if is_there $shapes.txt && is_there $shapes.truth.csv; then
  options=("$recordings/$shapes.txt" --width 240 --height 180 --truth "$recordings/$shapes.truth.csv"
    --size-model)
  add "ellipse of shapes_rotation" ellipse "${options[@]}" "$(size_file ellipse 33 23 -28)"
  add "ellipse, lean forgotten" ellipse-upright "${options[@]}" "$(size_file ellipse-upright 33 23)"
fi

for sequence in still_faint_6_m_s moving_faint_5_m_s moving_round_logos still_shots_15_m_s; do
  base=second_simulator/$sequence
  if is_there $base.raw && is_there $base.truth.csv; then
    size=$(calibrated $sequence "$recordings/$base.truth.csv" 640 480)
    options=("$recordings/$base.raw" --truth "$recordings/$base.truth.csv" --size-model)
    add "second simulator: $sequence" $sequence "${options[@]}" "$size"
    for factor in $wrong_factors; do
      add "second simulator, wrong sizes: $sequence" "$sequence-times-$factor" "${options[@]}" \
        "$(calibrated "$sequence-times-$factor" "$recordings/$base.truth.csv" 640 480 "$factor")"
    done
  fi
done

sizes=("$(size_file puck16 16 12)" "$(size_file puck32 32 24)" "$(size_file puck48 48 36)"
  "$root/config/calibration/simulated_size.toml")
without_puck() { # TITLE FILE [OPTION of puck-evaluate...]
  is_there "$2" || return 0
  local size
  for size in "${sizes[@]}"; do
    add "$1" "$(basename "$2")-$(basename "$size" .toml)" "$recordings/$2" --no-puck \
      --size-model "$size" "${@:3}"
  done
}
without_puck "no disc: dynamic_translation" dynamic_translation_davis240c_240x180.txt --width 240 --height 180
without_puck "no disc: driving" driving_gen41_1280x720_evt3.raw
without_puck "no disc: sparklers" sparklers_gen31_640x480_evt2.raw
without_puck "no disc: walking" walking_640x480_evt3.extracted.raw --width 640 --height 480
without_puck "no disc: plane" plane_320x240.es
without_puck "no disc: car" ncars_td.dat --width 78 --height 42
without_puck "no puck, two flickering lamps" lab_lamps_davis346_346x260.aedat4

if [ ${#plan[@]} -eq 0 ]; then refuse "none of the recordings is in $recordings"; fi

fast_dot() { # PX_PER_S TRAIL_MS: writes a text recording and its truth; prints their path without ending
  local base=$output/dots/$1-$2
  awk -v speed="$1" -v trail_us="${2}e3" -v truth="$base.truth.csv" '
    function emit(t, x, y, p) { printf "%d %d %d %d\n", t, x, y, p }
    BEGIN {
      srand(1)
      step_us = 20; turn = speed * 1e-6 / 100
      print "t_us,x,y,width,height" >truth
      for (t = 0; t <= 50000; t += step_us) {
        x = 320 + 100 * cos(turn * t); y = 240 + 100 * sin(turn * t)
        if (t % 1000 == 0) printf "%d,%.3f,%.3f,14,14\n", t, x, y >truth
        for (i = int(x) - 9; i <= int(x) + 9; i++) for (j = int(y) - 9; j <= int(y) + 9; j++) {
          inside = (i - x) ^ 2 + (j - y) ^ 2 < 49
          was = t > 0 ? (i - last_x) ^ 2 + (j - last_y) ^ 2 < 49 : inside
          if (inside == was) continue
          emit(t + step_us * rand(), i, j, !inside)
          for (k = 1; k < 6; k++) emit(t - trail_us * log(1 - rand()), i, j, !inside)
        }
        last_x = x; last_y = y
      }
      for (k = 0; k < 0.5 * 640 * 480 * 0.05; k++) emit(50000 * rand(), 640 * rand(), 480 * rand(), rand() < 0.5)
    }' | sort -n >"$base.txt"
  echo "$base"
}

mkdir -p "$output/dots"
for speed in 5000 10000 20000; do
  for trail_ms in 0.3 1 2; do
    base=$(fast_dot $speed $trail_ms)
    add "dot at $speed px/s, simulated" "dot-$speed-$trail_ms" "$base.txt" --width 640 --height 480 --unit us \
      --truth "$base.truth.csv" --size-model "$(size_file dot 14 14)"
  done
done

# The following also runs in the shells started by xargs.
export output programs evidence scale

run() { # CONTESTANT LINE-OF-THE-PLAN
  set -euo pipefail
  local fields title name options
  IFS=$'\t' read -ra fields <<<"$2"
  title=${fields[0]}
  name=$output/runs/${fields[1]}-$1
  case "$1" in
    default)
      options=(--preset default)
      local fit=$evidence/without-${fields[1]%%-*}.toml
      [ -f "$fit" ] || fit=$evidence/all.toml
      [ -z "$evidence" ] || options+=(--evidence "$fit")
      [ -z "$scale" ] || options+=(--scale-decision "$scale")
      ;;
    correlation | paper | reference) options=(--preset "$1") ;;
    *-tos | *-sits | *-sae) options=(--preset "${1%-*}" --surface "${1#*-}") ;;
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

if [ -n "$evidence" ]; then
  own=$(cd "$evidence" && find . -name 'without-*.toml' -printf ' %f' | sort)
  echo "$me: fits that leave a recording out:${own:- none}" >&2
fi

echo
echo "| recording | tracker | mean px | median px | lost % | said and wrong % | first found, ms | CPU, µs/ms |"
echo "|---|---|---:|---:|---:|---:|---:|---:|"
print_rows

for file in "${missing[@]}"; do echo "$me: not in $recordings: $file" >&2; done
while IFS= read -r file; do
  case " ${used[*]} " in *" $file "*) ;; *) echo "$me: in no row: $file" >&2 ;; esac
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
