#!/usr/bin/env bash
# Plays air hockey in a closed loop on the simulated table and prints the share of saved shots: camera,
# tracker, bridge and arm as in the services, in steps and as fast as the machine can.
#
#   tools/play.sh [--seconds N | --shots N] [--max-speed M_PER_S] [--source truth|events]
#                 [--real-time] [--sweep latency|speed|loss|rate] [--json FILE] [--plots DIR]
#                 [--moving] [OPTION...]
#
# --seconds N     length of a whole game (default 60)
# --shots N       number of single shots instead, each a game of its own: the puck is served, comes to
#                 rest, and the opponent shoots at the robot's goal, directly or by a rail
# --max-speed V   speed of the fastest shots, m/s; the slowest are half as fast (default 4; of a sweep 15)
# --source truth  estimates are the true position plus the errors of PUCK
#        events   estimates are PUCK's, from the events of the simulated camera
# --real-time     a whole game on events, with the five services as processes
# --sweep WHAT    save rate as a function of this quantity, for PUCK and other trackers, with --shots
#                 (default 200) at each point
# --json FILE     write the figures there
# --plots DIR     write plots there, of --shots or a --sweep
#
# --moving        the camera's head turns; in steps only with --source events
#
# In steps, also: --seed, --jobs, --latency-ms, --rate-hz, --loss-percent, --burst-ms, --frames-hz and
# --fit-estimate-errors; see build/release/bin/puck-play --help.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)

usage() { # EXIT_CODE
  sed -n '2,/^set /s/^# \{0,1\}//p' "$root/tools/play.sh" | sed '/^set /d'
  exit "$1"
}

refuse() { # MESSAGE
  echo "play.sh: $1" >&2
  usage 2
}

real_time=false
for option in "$@"; do
  case "$option" in
    --real-time) real_time=true ;;
    -h | --help) usage 0 ;;
  esac
done

seconds=60
max_speed=4
json=
moving=false
if $real_time; then
  while [ $# -gt 0 ]; do
    case "$1" in
      --real-time) shift ;;
      --seconds) seconds=${2-} && shift 2 || usage 2 ;;
      --max-speed) max_speed=${2-} && shift 2 || usage 2 ;;
      --json) json=$(realpath -m "${2-}") && shift 2 || usage 2 ;;
      --source)
        [ "${2-}" = events ] || refuse "--source ${2-} does not go with --real-time, whose source is events"
        shift 2
        ;;
      --moving) moving=true && shift ;;
      *) refuse "$1 does not go with --real-time" ;;
    esac
  done
  [[ "$seconds" =~ ^[1-9][0-9]{0,4}$ ]] ||
    refuse "--seconds takes a whole number from 1 to 99999, got $seconds"
  [[ "$max_speed" =~ ^[0-9]{1,2}(\.[0-9]+)?$ ]] &&
    awk "BEGIN { exit !($max_speed >= 0.6 && $max_speed <= 15) }" ||
    refuse "--max-speed takes a number from 0.6 to 15 with --real-time, got $max_speed"
fi

target=puck-play
if $real_time; then target=puck_programs; fi
"$root/tools/build.sh" $target
bin=$root/build/release/bin
if ! $real_time; then exec "$bin/puck-play" --calibration "$root/config/calibration" "$@"; fi
cd "$root"
# shellcheck source=tools/services.sh
. tools/services.sh
play_game "$(url_of "$(free_port)")" "$seconds" --set "simulation.world.moving_camera=$moving" \
  --set "simulation.game.shot_speed_max_m_s=$max_speed" \
  --set "simulation.game.shot_speed_min_m_s=$(awk "BEGIN { print $max_speed / 2 }")"
echo
"$bin/puck-play" --log "$work/game.lcm" ${json:+--json "$json"}
