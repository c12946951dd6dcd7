#!/usr/bin/env bash
# Installs missing packages and builds these targets, optimised, into build/release.
#
#   tools/build.sh [--preset PRESET] TARGET...
#
# --preset: another one of CMakePresets.json, into build/PRESET. Shows progress: in one rewritten line on a
# terminal, else in a line every ten per cent.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."
preset=release
if [ "${1-}" = --preset ]; then
  preset=${2-}
  shift 2
fi
folder=build/$preset

fail() { # MESSAGE
  echo "build.sh: $1" >&2
  exit 1
}

# Only for a new build or changed presets: Ninja notices all other changes.
configure() {
  [ "$folder/build.ninja" -nt CMakePresets.json ] && return
  local is_new=true log
  [ ! -e "$folder" ] || is_new=false
  mkdir -p "$folder" 2>/dev/null && [ -w "$folder" ] ||
    fail "$PWD/$folder cannot be written: build in a clone that you own"
  if ! log=$(cmake --preset "$preset" 2>&1); then
    # CMake's cache of a failed attempt would spoil the next one.
    ! $is_new || rm -rf "$folder"
    tail -n 20 <<<"$log" >&2
    fail "CMake cannot configure $folder; $(reason "$log")"
  fi
  touch "$folder/build.ninja"
}

reason() { # OUTPUT
  if [[ $1 == *"No space left on device"* ]]; then
    echo "the disk is full: free 1 GB and run it again"
  else
    echo "the lines above say why"
  fi
}

# Reads Ninja's output with the status "@BUILT/ALL@ "; prints the reason of a failure.
show_progress() {
  local line built all tenth last_tenth=0 other=() open=false
  while IFS= read -r line; do
    if [[ ! $line =~ ^@([0-9]+)/([0-9]+)@\ (.*) ]]; then
      other+=("$line")
      continue
    fi
    [[ ${BASH_REMATCH[3]} != Re-* ]] || continue # Ninja looks for new sources.
    built=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    tenth=$((10 * built / all))
    if [ -t 1 ]; then
      printf '\r\033[Kbuilding %d of %d' "$built" "$all"
      open=true
    elif ((built == 1 || tenth > last_tenth)); then
      echo "building $built of $all"
    fi
    last_tenth=$tenth
  done
  ! $open || echo
  [[ " ${other[*]} " == *"FAILED: "* || " ${other[*]} " == *"ninja: error"* ]] || return 0
  local all_other
  all_other=$(printf '%s\n' "${other[@]}")
  if [[ $all_other == *"No space left on device"* ]]; then
    fail "$folder cannot be built; $(reason "$all_other")"
  fi
  # Without the compilers' command lines, which are long.
  grep -v '^/.* -c \|^: && ' <<<"$all_other" | tail -n 40 >&2
  fail "$folder cannot be built; $(reason "$all_other")"
}

tools/install-deps.sh
configure
NINJA_STATUS='@%f/%t@ ' cmake --build --preset "$preset" -j "$(nproc)" --target "$@" 2>&1 |
  show_progress
