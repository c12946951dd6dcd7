#!/usr/bin/env bash
# Installs the Debian 12 packages for building, running and testing the project. Prints nothing and needs no
# network if all are installed. On failure, prints one line on stderr with the problem and the remedy; exit
# code 1.
#
#   tools/install-deps.sh [--browser]     --browser: also Chromium, which tests the page of puck-view
set -euo pipefail

fail() { # TEXT
  echo "install-deps.sh: $1" >&2
  exit 1
}

packages=(
  ca-certificates ccache clang cmake debootstrap g++ git iproute2 iptables libclang-rt-14-dev
  nftables ninja-build procps
  doctest-dev libbenchmark-dev libboost-dev libcli11-dev libeigen3-dev libfaketime libhwy-dev liblcm-bin
  liblcm-dev libncurses-dev libopencv-dev libsodium-dev libspdlog-dev libtomlplusplus-dev
  hdf5-filter-plugin-blosc-serial libdeflate-dev libhdf5-dev liblz4-dev libzstd-dev
  nlohmann-json3-dev pkg-config python3 python3-matplotlib zlib1g-dev
)
if [ "${1-}" = --browser ]; then packages+=(chromium chromium-driver python3-pil); fi
# With Docker, the container tests need Compose.
if command -v docker >/dev/null && ! command -v docker-compose >/dev/null &&
  ! docker compose version >/dev/null 2>&1; then
  packages+=(docker-compose)
fi

check_version() { # PROGRAM FOUND LEAST HOW
  [ "$(printf '%s\n' "$3" "$2" | sort -V | head -n 1)" = "$3" ] ||
    fail "$1 is version ${2:-unknown}, and $3 or newer is needed; $4"
}
check_tools() {
  local compiler=${CXX:-c++} how="install Debian 12's g++, or name a newer compiler with CXX=..."
  if "$compiler" --version 2>/dev/null | head -n 1 | grep -q clang; then
    check_version "$compiler" "$("$compiler" -dumpversion)" 14 "$how"
  else
    check_version "$compiler" "$("$compiler" -dumpfullversion 2>/dev/null)" 12 "$how"
  fi
  check_version cmake "$(cmake --version 2>/dev/null | sed -n '1s/[^0-9]*//p')" 3.25 \
    "install Debian 12's cmake, and put it first on PATH"
}

command -v dpkg-query >/dev/null ||
  fail "no dpkg here; install these packages of Debian 12 by other means: ${packages[*]}"
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  check_tools
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    fail "not root, and no sudo; as root, run: apt-get install ${missing[*]}"
  as_root=(sudo)
fi

log=$(mktemp 2>/dev/null) || fail "no space for a file in ${TMPDIR:-/tmp}; free some, then run it again"
trap 'rm -f "$log"' EXIT
# apt-get checks the disk space and fetches all packages before it changes anything.
apt() { # ARGUMENT...
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -qq "$@" >"$log" 2>&1
}
echo "installing ${missing[*]}"
if ! apt update -o APT::Update::Error-Mode=any ||
  ! apt install -y --no-install-recommends "${missing[@]}"; then
  if grep -qE 'No space left|enough free space' "$log"; then
    fail "the disk is full: $(grep -m 1 -E 'No space left|enough free space' "$log"); free some, then run it again"
  elif grep -qE 'Could not (resolve|connect)|Failed to fetch|Network is unreachable' "$log"; then
    fail "no network to Debian's mirror: $(grep -m 1 -E 'Could not|Failed|unreachable' "$log"); connect, then run it again"
  fi
  fail "apt-get failed: $(grep -m 1 -E '^(E:|sudo:|dpkg:)' "$log" || tail -n 1 "$log"); fix it, then run: apt-get install ${missing[*]}"
fi
check_tools
