#!/usr/bin/env bash
# Plays games between containers, each on a machine of its own as far as the services can tell, does
# to them what happens to machines, and judges each from the log of its bus.
#
#   tests/containers/run.sh [SCENARIO...]      default: all; --list names them
#
# Takes the programs in build/release/bin; tests/run.sh containers builds them first. Prints a line a
# scenario; exits with 1 when one failed. Leaves nothing behind: no container, network, volume or
# image, but a base image that was there before.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/../.."

all=(game loss_1 loss_5 narrow killed frozen cut_off neighbours intruder)
case "${1-}" in
  --list)
    printf '%s\n' "${all[@]}"
    exit
    ;;
  -*)
    sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d' >&2
    exit 2
    ;;
esac
scenarios=("${@:-${all[@]}}")
for scenario in "${scenarios[@]}"; do
  [[ " ${all[*]} " = *" $scenario "* ]] || {
    echo "containers: no scenario '$scenario'; there are ${all[*]}" >&2
    exit 2
  }
done

if docker compose version >/dev/null 2>&1; then
  compose_program=(docker compose)
elif command -v docker-compose >/dev/null; then
  compose_program=(docker-compose)
else
  echo "containers: Docker is here, but not Compose; mend it with: apt-get install docker-compose" >&2
  exit 1
fi

run=puck-test-$$
base=$(docker/base-image.sh --name)
work=$(mktemp -d)
export PUCK_TEST_IMAGE=$run PUCK_NETWORK=$run PUCK_LOG=game.lcm
url="udpm://239.255.76.67:7667?ttl=1"
# Compose's project: one robot. All of them are on the same network.
robot=$run
robots=("$run" "$run-left" "$run-right" "$run-replay")

remove_all() {
  remove_robots
  docker network rm "$run" >/dev/null 2>&1 || true
  docker image rm -f "$run" >/dev/null 2>&1 || true
  $had_base || docker image rm "$base" >/dev/null 2>&1 || true
  rm -rf "$work"
}
had_base=true
trap remove_all EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# --- Machines ------------------------------------------------------------------------------------

compose() { # ARGUMENT...
  "${compose_program[@]}" -p "$robot" -f docker/compose.test.yaml "$@" >>"$work/compose.log" 2>&1
}
remove_robots() {
  local one
  for one in "${robots[@]}"; do
    [ -z "$(docker ps -aq --filter "label=com.docker.compose.project=$one")" ] ||
      robot=$one compose down --volumes --remove-orphans --timeout 2 || true
    # Of a start that failed before its first container.
    docker volume rm -f "${one}_logs" >/dev/null 2>&1 || true
  done
}
machine() { # SERVICE, prints the id of its container
  docker ps -aq --filter "label=com.docker.compose.project=$robot" \
    --filter "label=com.docker.compose.service=$1"
}
check() { # SERVICE [PREFIX], from its machine
  docker exec "$(machine "$1")" "puck-$1" --check --lcm-url "$url" \
    --prefix "${2-${PUCK_PREFIX-}}" >/dev/null
}

# A check waits for 2 s, and a busy machine starts a container more slowly.
await_check() { # SERVICE
  local end=$((SECONDS + 30))
  until check "$1"; do
    if [ "$SECONDS" -ge "$end" ]; then
      echo "    wrong: the $1 does not become healthy"
      return 1
    fi
    sleep 0.2
  done
}

start_services() { # SERVICE...
  local service
  compose up -d "$@"
  for service in "$@"; do await_check "$service"; done
}
start_game() {
  start_services logger tracker bridge arm
  # Alone and last, so that everybody hears its first event.
  compose up -d --no-deps camera
}
# The camera first, so that all that it sent arrives; the logger last.
stop_game() {
  docker stop -t 2 "$(machine camera)" >/dev/null
  sleep 0.2
  docker stop -t 2 "$(machine bridge)" "$(machine arm)" "$(machine tracker)" >/dev/null
  docker stop -t 2 "$(machine logger)" >/dev/null
}

# Prints the scenario's line of the table.
judge() { # TITLE ARGUMENT..., as puck-container-verdict takes them
  local title=$1
  shift
  docker run --rm --network none -v "${robot}_logs:/logs:ro" "$run" \
    puck-container-verdict "$@" --title "$title"
}

# --- Scenarios -----------------------------------------------------------------------------------

seconds=8

scenario_game() {
  start_game
  sleep "$seconds"
  # Docker itself asks for their health, every 5 s. The simulated camera is not well where the
  # machine is too slow for it.
  local service
  for service in logger tracker bridge arm; do await_health "$service"; done
  stop_game
  judge "five machines" nothing-lost /logs/game.lcm
  replay_game
}
await_health() { # SERVICE
  local health i
  for i in $(seq 100); do
    health=$(docker inspect -f '{{.State.Health.Status}}' "$(machine "$1")")
    [ "$health" = healthy ] && return
    sleep 0.2
  done
  echo "    wrong: Docker says that the $1 is $health"
  return 1
}
# LCM's own player on one machine plays the log of another to a new tracker on a third.
replay_game() {
  local game_logs=${robot}_logs
  local robot=$run-replay
  PUCK_LOG=replay.lcm start_services logger tracker
  docker run --rm --network "$run" -v "$game_logs:/logs:ro" "$run" \
    lcm-logplayer --lcm-url="$url" --regexp='^PUCK_EVENTS$' /logs/game.lcm \
    >>"$work/compose.log" 2>&1
  docker stop -t 2 "$(machine tracker)" >/dev/null
  docker stop -t 2 "$(machine logger)" >/dev/null
  docker run --rm --network none -v "$game_logs:/logs:ro" -v "${robot}_logs:/replay:ro" "$run" \
    puck-container-verdict replay /logs/game.lcm --replay /replay/replay.lcm \
    --title "its log, to a new tracker"
}

# A game that compose.test.yaml plays and judges by itself; its exit code is the verdict.
spoilt_network() { # TITLE FAULT SERVICE ARGUMENT..., as puck-container-verdict takes them
  local title=$1 fault=$2 at=$3 code=0
  shift 3
  PUCK_TEST_FAULT=$fault PUCK_TEST_FAULT_AT=$at PUCK_TEST_SECONDS=$seconds \
    PUCK_TEST_SCENARIO="$* --title '$title'" compose up --exit-code-from verdict || code=$?
  docker logs "$(machine verdict)"
  return "$code"
}
scenario_loss_1() { spoilt_network "1 % of frames lost" "loss 1" tracker frame-loss --percent 1; }
scenario_loss_5() { spoilt_network "5 % of frames lost" "loss 5" tracker frame-loss --percent 5; }
scenario_narrow() { spoilt_network "link of 100 Mbit/s" "narrow 100" camera narrow-link; }

scenario_killed() {
  start_game
  sleep 4
  docker kill "$(machine tracker)" >/dev/null
  sleep 1
  docker start "$(machine tracker)" >/dev/null
  sleep 4
  stop_game
  judge "tracker killed, started again" killed-tracker /logs/game.lcm
}

scenario_frozen() {
  start_game
  sleep 4
  docker pause "$(machine bridge)" >/dev/null
  sleep 2
  docker unpause "$(machine bridge)" >/dev/null
  sleep 3
  stop_game
  judge "bridge frozen for 2 s" frozen-bridge /logs/game.lcm
}

scenario_cut_off() {
  start_game
  sleep 4
  docker network disconnect "$run" "$(machine tracker)"
  sleep 3
  docker network connect "$run" "$(machine tracker)"
  sleep 4
  stop_game
  judge "tracker's network away for 3 s" cut-off-tracker /logs/game.lcm
}

# At half the speed: two simulated tables are more than two cores can do.
scenario_neighbours() {
  export PUCK_SPEED=0.5
  robot=$run-left PUCK_PREFIX=LEFT start_game
  robot=$run-right PUCK_PREFIX=RIGHT start_game
  sleep "$seconds"
  # They could hear each other.
  robot=$run-left check tracker RIGHT
  robot=$run-left stop_game
  robot=$run-right stop_game
  robot=$run-left judge "two robots: the left one" neighbour /logs/game.lcm --prefix LEFT
  robot=$run-right judge "two robots: the right one" neighbour /logs/game.lcm --prefix RIGHT
}

# Twice: the first time fills what may be filled, queues and the allocator's memory; the second time
# nobody may grow. Without the attack that sends valid messages of a stranger, truth among them, for
# that is what the verdict rests on.
scenario_intruder() {
  start_game
  sleep 3
  intrude 1
  resident_memory >"$work/memory_before"
  intrude 2
  resident_memory >"$work/memory_after"
  sleep 3
  stop_game
  local service before after memory=()
  while read -r service before _ after; do
    memory+=(--memory "puck-$service" "$before" "$after")
  done < <(paste "$work/memory_before" "$work/memory_after")
  judge "an intruder" intruder /logs/game.lcm "${memory[@]}"
}
intrude() { # SEED
  local attack
  for attack in fragments names headers random counts payloads fingerprints values channels flood; do
    echo "puck-intruder --lcm-url '$url' --seconds 0.2 --seed $1 --attack $attack"
  done | docker run --rm -i --network "$run" "$run" sh -e >>"$work/compose.log"
}
resident_memory() { # a line for each service: its name, and kB
  local service
  for service in camera tracker bridge arm; do
    echo "$service $(docker exec "$(machine "$service")" sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' \
      /proc/1/status)"
  done
}

# --- All of them ---------------------------------------------------------------------------------

docker image inspect "$base" >/dev/null 2>&1 || had_base=false
docker/base-image.sh
if ! docker build --force-rm -f docker/Dockerfile --target test -t "$run" . >"$work/build.log" 2>&1; then
  tail -n 30 "$work/build.log" >&2
  echo "containers: the image cannot be built" >&2
  exit 1
fi
echo "image for tests: built from build/release/bin"
echo
printf '%-31s %8s %8s %6s %6s %6s %5s %5s  %s\n' \
  scenario events lost Hz median "mean px" shots saves verdict

failed=()
for scenario in "${scenarios[@]}"; do
  : >"$work/compose.log"
  # In a process of its own, so that it stops where it fails and what it sets is gone after it.
  set +e
  (
    set -e
    "scenario_$scenario"
  ) 2>"$work/errors"
  code=$?
  set -e
  if [ "$code" -ne 0 ]; then
    failed+=("$scenario")
    tail -q -n 5 "$work/errors" "$work/compose.log"
  fi
  remove_robots
done
echo
if [ ${#failed[@]} -gt 0 ]; then
  echo "containers: FAILED: ${failed[*]}"
  exit 1
fi
echo "containers: all ${#scenarios[@]} scenarios passed"
