#!/usr/bin/env bash
# Plays a game of air hockey on the simulated table, with a process for each service, and prints the result.
# Then LCM's player replays the recorded events at twice the speed into a second tracker, and its estimates
# are compared with the recorded ones.
#
#   tools/demo.sh [--seconds N] [--moving] [--view] [--json FILE]
#
# --seconds N   length of the game (default 20)
# --moving      the camera's head turns; on a slow machine, the game is slower
# --view        show the game in a browser while it plays: opens the page if there is a screen
# --json FILE   write the figures to this file
#
# The first run installs missing packages and builds. The services use unused LCM ports on this machine only:
# no other demo and no robot receives their messages. Exit code 1: a service died or the puck was never
# tracked.
set -euo pipefail

usage() { # EXIT_CODE
  sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d'
  exit "$1"
}
can_write() { # FILE
  if [ -e "$1" ]; then
    [ -w "$1" ] && ! [ -d "$1" ]
  else
    [ -w "$(dirname -- "$1")" ]
  fi
}

seconds=20
moving=false
view=false
json=
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds=${2-} && shift 2 || usage 2 ;;
    --json) json=$(realpath -m -- "${2-}" 2>/dev/null) && shift 2 || usage 2 ;;
    --moving) moving=true && shift ;;
    --view) view=true && shift ;;
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

if [ -n "$json" ] && ! can_write "$json"; then
  echo "demo.sh: $json cannot be written: name a file in an existing folder that you own" >&2
  exit 1
fi

CDPATH='' cd "$(dirname "$0")/.."
programs=(puck-{camera,tracker,bridge,arm,logger,demo-report})
! $view || programs+=(puck-view puck-doctor)
tools/build.sh "${programs[@]}"
bin=build/release/bin

# shellcheck source=tools/services.sh
. tools/services.sh
game_url=$(url_of "$(free_port)")
replay_url=$(url_of "$(free_port)")

# Opens the page of puck-view, or tells its address.
show_page() { # URL
  local page=
  start puck-view "$1" --listen 127.0.0.1:0 >"$work/page"
  while [ -z "$page" ]; do
    check_alive
    sleep 0.05
    page=$(sed -n 's/^open //p' "$work/page")
  done
  echo "the game is shown at $page"
  if [ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ] && command -v xdg-open >/dev/null; then
    xdg-open "$page" >/dev/null 2>&1 || true
  fi
}
! $view || show_page "$game_url"

play_game "$game_url" "$seconds" --set "simulation.world.moving_camera=$moving"

echo "replaying the events"
start puck-logger "$replay_url" --config config/logger.toml --set "logger.path=$work/replay.lcm"
start puck-tracker "$replay_url" --config config/tracker.toml
for name in puck-logger puck-tracker; do await "$name" "$replay_url"; done
run_beside lcm-logplayer \
  lcm-logplayer --speed=2 --lcm-url="$replay_url" --regexp='^PUCK_EVENTS$' "$work/game.lcm" >/dev/null
sleep 0.2
for name in puck-tracker puck-logger; do stop "$name"; done

echo
"$bin/puck-demo-report" "$work/game.lcm" --replay "$work/replay.lcm" ${json:+--json "$json"}
