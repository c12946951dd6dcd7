# Runs the services of a game. To be sourced in the project's root, with `bin` set to the folder of the
# programs. Each service is a process of its own, on an unused LCM port of this machine. `work` is a temporary
# folder, removed when the script ends; it holds NAME.log, the stderr of service NAME.
me=$(basename "$0")

# Empty until it exists, so that an early interrupt removes nothing.
work=
pids=()
names=()
line_is_open=false # Whether the cursor is in a rewritten line.

end_line() {
  ! $line_is_open || echo
  line_is_open=false
}
kill_all() {
  local pid
  for pid in "${pids[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do
    # A service ends within 200 ms. After 3 s it is killed.
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
trap 'kill_all; end_line; rm -rf ${work:+"$work"}' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

die() { # MESSAGE [LOG]
  end_line
  echo "$me: $1" >&2
  # Without the settings at the log's beginning: only warnings and errors.
  if [ -n "${2-}" ]; then grep -v ' info: ' "$2" | tail -n 15 >&2 || true; fi
  exit 1
}

work=$(mktemp -d 2>/dev/null) ||
  die "no temporary folder can be made in ${TMPDIR:-/tmp}: free some space there, or set TMPDIR"

# A UDP port that no socket uses.
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
# Waits until a service publishes STATUS, even if it still waits for its input.
await() { # NAME URL
  local name=$1 url=$2
  for _ in $(seq 10); do
    "$bin/$name" --lcm-url "$url" --check >"$work/check" 2>&1 && return
    grep -q waiting "$work/check" && return
    check_alive
  done
  if grep -q multicast "$work/check"; then
    die "this machine has no multicast route: make one with 'ip route add 224.0.0.0/4 dev lo' as root"
  fi
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

# Runs a program to its end. If a service dies meanwhile, the script ends.
run_beside() { # NAME COMMAND...
  local name=$1 first='' code=0 i
  shift
  "$@" 2>"$work/$name.log" &
  pids+=($!)
  names+=("$name")
  wait -n -p first "${pids[@]}" || code=$?
  for i in "${!pids[@]}"; do
    [ "${pids[$i]}" = "$first" ] || continue
    [ "${names[$i]}" = "$name" ] || die "${names[$i]} died with exit code $code" \
      "$work/${names[$i]}.log"
    unset "pids[$i]" "names[$i]"
  done
  [ "$code" -eq 0 ] || die "$name ended with exit code $code" "$work/$name.log"
}

# The logs of a game and its replay take up to 8 MB per second; the logger leaves 64 MB free.
require_space() { # SECONDS
  local needed_mb=$((100 + 8 * $1)) free_mb
  free_mb=$(df -BM --output=avail "$work" | tr -dc 0-9)
  [ "$free_mb" -ge "$needed_mb" ] ||
    die "$(dirname "$work") has $free_mb MB free, a game of $1 s needs $needed_mb MB: free some, or set \
TMPDIR to another folder"
}

# Plays a game and logs it in $work/game.lcm.
play_game() { # URL SECONDS [CAMERA_OPTION...]
  local url=$1 seconds=$2 name late_ms
  shift 2
  require_space "$seconds"
  echo "starting the services"
  start puck-logger "$url" --config config/logger.toml --set "logger.path=$work/game.lcm"
  start puck-tracker "$url" --config config/tracker.toml
  start puck-bridge "$url" --config config/bridge.toml
  start puck-arm "$url" --config config/arm.toml
  for name in puck-logger puck-tracker puck-bridge puck-arm; do await "$name" "$url"; done
  start puck-camera "$url" --config config/camera.toml "$@"
  await puck-camera "$url"

  echo "playing for $seconds s"
  ! [ -t 1 ] || line_is_open=true
  run_beside puck-demo-report "$bin/puck-demo-report" --live "$url" --seconds "$seconds"
  line_is_open=false
  # The camera first, so that all its messages arrive; the logger last.
  for name in puck-camera puck-bridge puck-arm puck-tracker puck-logger; do stop "$name"; done
  late_ms=$(sed -n 's/.*cannot keep up: \([0-9]*\) ms late.*/\1/p' "$work/puck-camera.log" |
    sort -n | tail -n 1)
  [ -z "$late_ms" ] ||
    echo "the simulation ran up to $late_ms ms behind real time, as the machine was busy; latencies include that"
}
