# Plays simulated games and scores the tracker on them. To be sourced by a script with `root` set to the
# project's root; the comment at that script's beginning, up to its `set`, is its help.
me=$(basename "$0")

usage() { # EXIT_CODE
  sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d'
  exit "$1"
}

refuse() { # MESSAGE
  echo "$me: $1" >&2
  exit 2
}

require_seconds() { # VALUE
  [[ $1 =~ ^[0-9]+(\.[0-9]+)?$ ]] || refuse "--seconds takes a number, got $1"
}

require_jobs() { # VALUE
  [[ $1 =~ ^[1-9][0-9]{0,3}$ ]] || refuse "--jobs takes a whole number from 1 to 9999, got $1"
}

# Sets `programs` to the folder with these programs; if it is empty, builds them.
require_programs() { # NAME...
  local program
  if [ -z "$programs" ]; then
    "$root/tools/build.sh" "$@" >&2
    programs=$root/build/release/bin
  fi
  for program in "$@"; do
    [ -x "$programs/$program" ] || refuse "no program $programs/$program"
  done
}

# Prints the tracker's figures for the game BASE.raw: "mean_px lost_percent longest_loss_ms".
score() { # BASE SIZE_MODEL [OPTION of puck-evaluate...]
  local told
  told=$("$programs/puck-evaluate" "$1.raw" --truth "$1.truth.csv" --size-model "${@:2}") || return
  awk '{ is[$1] = $2 }
    END {
      if (is["mean_px"] !~ /^[0-9]/ || is["lost_percent"] !~ /^[0-9]/) {
        print "a game cannot be scored: is its puck ever visible?" >"/dev/stderr"
        exit 1
      }
      print is["mean_px"], is["lost_percent"], is["longest_loss_ms"]
    }' <<<"$told"
}

# Calibrates the puck's size as a user would: on every 97th row of the truth, or on all of fewer than 1,000.
# Writes FILE.toml, and the rows to FILE.marks.csv.
calibrate_size() { # TRUTH WIDTH HEIGHT FILE [FACTOR]: of sizes times FACTOR
  awk -F, -v OFS=, -v rows="$(wc -l <"$1")" -v factor="${5:-1}" '
    NR > 1 && factor != 1 { $4 *= factor; $5 *= factor }
    NR == 1 || rows <= 1000 || NR % 97 == 2' "$1" >"$4.marks.csv"
  "$programs/puck-calibrate" size "$4.marks.csv" --output "$4.toml" --width "$2" --height "$3" >&2
}

# Runs a function in a shell of its own, because bash disables -e within a function whose result is tested.
# Prints how it ended and, after a failure, the end of its log.
logged() { # NAME LOG FUNCTION [ARGUMENT...]
  if bash -c '"$@"' "$3" "${@:3}" 2>"$2"; then
    echo "$1 is done" >&2
  else
    echo "$1 failed; $2 ends with:" >&2
    tail -n 3 "$2" >&2
    return 1
  fi
}
export -f score calibrate_size logged
