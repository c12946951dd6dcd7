#!/usr/bin/env bash
# Makes the image debian:bookworm-slim available and reports how: it existed, was pulled, or,
# without a registry, was made from Debian's packages (as root or with sudo; half a minute). That
# result is kept in build/docker, so that the next run takes seconds.
#
#   docker/base-image.sh [--name]      --name: only says its name
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."

image=debian:bookworm-slim
if [ "${1-}" = --name ]; then
  echo "$image"
  exit 0
fi
archive=build/docker/bookworm.tar

if docker image inspect "$image" >/dev/null 2>&1; then
  echo "base image $image: is there"
  exit 0
fi
# In the foreground, so that it ends together with this script.
if timeout --foreground 180 docker pull -q "$image" >/dev/null 2>&1; then
  echo "base image $image: pulled"
  exit 0
fi

if [ ! -e "$archive" ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  tree=$(mktemp -d)
  trap '"${as_root[@]}" rm -rf --one-file-system "$tree" "$tree.log" "$archive.part"' EXIT
  trap 'exit 143' TERM
  if ! "${as_root[@]}" debootstrap --variant=minbase --include=ca-certificates bookworm "$tree" \
    >"$tree.log" 2>&1; then
    tail -n 20 "$tree.log" >&2
    echo "base-image.sh: $image cannot be pulled, and debootstrap failed" >&2
    exit 1
  fi
  # The folder becomes the image's root folder, which unprivileged users must be able to enter.
  "${as_root[@]}" chmod 755 "$tree"
  "${as_root[@]}" rm -rf "$tree"/var/cache/apt/archives "$tree"/var/lib/apt/lists
  mkdir -p "$(dirname "$archive")"
  "${as_root[@]}" tar -C "$tree" -c . >"$archive.part"
  mv "$archive.part" "$archive"
fi
docker import "$archive" "$image" >/dev/null
echo "base image $image: cannot be pulled here, made with debootstrap"
