#!/usr/bin/env bash
# Plays a game of air hockey on the simulated table through all the services, each a process of its
# own, and says what happened; then replays the recorded events with LCM's own player into a second
# tracker and compares the two.
#
#   tools/demo.sh [--seconds N] [--moving] [--json FILE]
#
# --seconds N   length of the game (default 20)
# --moving      the camera's head moves; slower than real time where the machine cannot keep up
# --json FILE   write the figures there
#
# Exits with 1 when a service died or nothing was tracked. Uses LCM ports of its own on this machine
# only, so that it never meets another demo or a robot.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."

usage() { # EXIT_CODE
  sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d'
  exit "$1"
}

seconds=20
moving=false
json=
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds=${2-} && shift 2 || usage 2 ;;
    --json) json=${2-} && shift 2 || usage 2 ;;
    --moving) moving=true && shift ;;
    -h | --help) usage 0 ;;
    *)
      echo "demo.sh: unknown option $1" >&2
      usage 2
      ;;
  esac
done
if ! [[ "$seconds" =~ ^[1-9][0-9]{0,4}$ ]]; then
  echo "demo.sh: --seconds takes a whole number from 1 to 99999, got '$seconds'" >&2
  exit 2
fi

tools/build.sh puck_programs
bin=build/release/bin

# shellcheck source=tools/services.sh
. tools/services.sh
game_url=$(url_of "$(free_port)")
replay_url=$(url_of "$(free_port)")

play_game "$game_url" "$seconds" --set "simulation.world.moving_camera=$moving"

echo "replaying the log"
start puck-logger "$replay_url" --config config/logger.toml --set "logger.path=$work/replay.lcm"
start puck-tracker "$replay_url" --config config/tracker.toml
for name in puck-logger puck-tracker; do await "$name" "$replay_url"; done
lcm-logplayer --lcm-url="$replay_url" --regexp='^PUCK_EVENTS$' "$work/game.lcm" \
  >"$work/player.log" 2>&1 &
player=$!
pids+=("$player")
names+=(lcm-logplayer)
wait "$player" || die "lcm-logplayer ended with exit code $?" "$work/player.log"
unset 'pids[-1]' 'names[-1]'
check_alive
sleep 0.2
for name in puck-tracker puck-logger; do stop "$name"; done

echo
"$bin/puck-demo-report" "$work/game.lcm" --replay "$work/replay.lcm" ${json:+--json "$json"}
