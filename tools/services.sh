# Runs the services for a script that wants to see a game: to be sourced, with `bin` set to where the
# programs are and the working folder at the project's root. Each service is a process of its own, on
# LCM ports of this machine only that nobody else uses. `work` is a folder that vanishes with the
# script; NAME.log in it is what a service said.
me=$(basename "$0")

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
  echo "$me: $1" >&2
  if [ -n "${2-}" ] && [ -s "$2" ]; then
    echo "the end of its log:" >&2
    tail -n 15 "$2" >&2
  fi
  exit 1
}

# That nobody uses.
free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 40000))
    ss -Hlun "sport = :$port" 2>/dev/null | grep -q . || break
  done
  echo "$port"
}
url_of() { # PORT
  echo "udpm://239.255.76.67:$1?ttl=0&recv_buf_size=4194304"
}

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

# Plays a game that is logged in $work/game.lcm.
play_game() { # URL SECONDS [CAMERA_OPTION...]
  local url=$1 seconds=$2 name second
  shift 2
  echo "starting the services"
  start puck-logger "$url" --config config/logger.toml --set "logger.path=$work/game.lcm"
  start puck-tracker "$url" --config config/tracker.toml
  start puck-bridge "$url" --config config/bridge.toml
  start puck-arm "$url" --config config/arm.toml
  for name in puck-logger puck-tracker puck-bridge puck-arm; do await "$name" "$url"; done
  start puck-camera "$url" --config config/camera.toml "$@"
  await puck-camera "$url"

  echo "playing for $seconds s"
  for ((second = 1; second <= seconds; ++second)); do
    sleep 1
    check_alive
    if ((second % 5 == 0 || second == seconds)); then echo "  $second s"; fi
  done
  # The camera first, so that everything it sent arrives; the logger last.
  for name in puck-camera puck-bridge puck-arm puck-tracker puck-logger; do stop "$name"; done
  grep -h "warning: .*cannot keep up" "$work/puck-camera.log" | tail -n 1 || true
}
