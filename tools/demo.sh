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
cd "$(dirname "$0")/.."

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

tools/install-deps.sh
echo "building"
cmake --preset release >/dev/null
cmake --build --preset release -j "$(nproc)" --target puck_programs -- --quiet
bin=build/release/bin

work=$(mktemp -d)
pids=()
names=()

kill_all() {
  local pid
  for pid in "${pids[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do
    # A service ends within 200 ms; what has not ended after 3 s is made to.
    for _ in $(seq 30); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
    kill -KILL "$pid" 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
  done
  pids=()
  names=()
}
trap 'kill_all; rm -rf "$work"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

die() { # MESSAGE [LOG]
  echo "demo.sh: $1" >&2
  if [ -n "${2-}" ] && [ -s "$2" ]; then
    echo "the end of its log:" >&2
    tail -n 15 "$2" >&2
  fi
  exit 1
}

# Two ports that nobody uses, game and replay.
free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 40000))
    ss -Hlun "sport = :$port" 2>/dev/null | grep -q . || break
  done
  echo "$port"
}
url_of() { echo "udpm://239.255.76.67:$1?ttl=0&recv_buf_size=4194304"; }
game_url=$(url_of "$(free_port)")
replay_url=$(url_of "$(free_port)")

start() { # NAME URL [OPTION...]
  local name=$1 url=$2
  shift 2
  "$bin/$name" --lcm-url "$url" "$@" 2>"$work/$name.log" &
  pids+=($!)
  names+=("$name")
}
# Does not wait for the service to have work to do, only for it to speak.
await() { # NAME URL
  local name=$1 url=$2 i
  for i in $(seq 10); do
    "$bin/$name" --lcm-url "$url" --check >"$work/check" 2>&1 && return
    grep -q waiting "$work/check" && return
  done
  die "$name did not start: $(cat "$work/check")" "$work/$name.log"
}
check_alive() {
  local i
  for i in "${!pids[@]}"; do
    kill -0 "${pids[$i]}" 2>/dev/null || die "${names[$i]} died" "$work/${names[$i]}.log"
  done
}
stop() { # NAME
  local i
  for i in "${!names[@]}"; do
    [ "${names[$i]}" = "$1" ] || continue
    kill -TERM "${pids[$i]}" 2>/dev/null || die "$1 died" "$work/$1.log"
    wait "${pids[$i]}" || die "$1 ended with exit code $?" "$work/$1.log"
    unset "pids[$i]" "names[$i]"
  done
}

echo "starting the services"
start puck-logger "$game_url" --config config/logger.toml --set "logger.path=$work/game.lcm"
start puck-tracker "$game_url" --config config/tracker.toml
start puck-bridge "$game_url" --config config/bridge.toml
start puck-arm "$game_url" --config config/arm.toml
for name in puck-logger puck-tracker puck-bridge puck-arm; do await "$name" "$game_url"; done
start puck-camera "$game_url" --config config/camera.toml --set "simulation.world.moving_camera=$moving"
await puck-camera "$game_url"

echo "playing for $seconds s"
for ((second = 1; second <= seconds; ++second)); do
  sleep 1
  check_alive
  if ((second % 5 == 0 || second == seconds)); then echo "  $second s"; fi
done
# The camera first, so that everything it sent arrives; the logger last.
for name in puck-camera puck-bridge puck-arm puck-tracker puck-logger; do stop "$name"; done
grep -h "late\|behind\|slower" "$work/puck-camera.log" | tail -n 1 || true

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
