#!/usr/bin/env bash
# Installs what the project needs to build, run and be tested, from Debian 12's packages. Says
# nothing and needs no network when everything is there.
set -euo pipefail

packages=(
  ca-certificates ccache clang cmake debootstrap g++ git iproute2 iptables libclang-rt-14-dev
  nftables ninja-build procps
  doctest-dev libbenchmark-dev libcli11-dev libeigen3-dev libfaketime libhwy-dev liblcm-bin
  liblcm-dev libncurses-dev libopencv-dev libsodium-dev libspdlog-dev libtomlplusplus-dev
  nlohmann-json3-dev
)

# Where there is Docker, the tests between containers need a Compose, too.
if command -v docker >/dev/null && ! command -v docker-compose >/dev/null &&
  ! docker compose version >/dev/null 2>&1; then
  packages+=(docker-compose)
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install-deps.sh: not root, and there is no sudo; install: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi

echo "installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -qq &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "install-deps.sh: apt-get failed" >&2
  exit 1
fi
