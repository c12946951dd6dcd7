#!/usr/bin/env bash
# Installs missing packages and builds these targets, optimised, into build/release.
#
#   tools/build.sh TARGET...
#
# Shows progress: in one rewritten line on a terminal, else in a line every ten per cent.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/.."
folder=build/release

fail() { # MESSAGE
  echo "build.sh: $1" >&2
  exit 1
}

# Checks versions first, for a clearer message than a compiler's.
require_tools() {
  local version
  version=$(cmake --version | sed -n '1s/[^0-9]*//p')
  [ "$(printf '%s\n' 3.25 "$version" | sort -V | head -n 1)" = 3.25 ] ||
    fail "CMake is $version, PUCK needs 3.25 or later: install a newer one, as in Debian 12"
  local compiler=${CXX:-c++}
  command -v "$compiler" >/dev/null ||
    fail "there is no compiler $compiler: install g++, or name another one with CXX=COMPILER"
  printf '%s\n' '#include <version>' \
    '#if __cpp_concepts < 201907L || __cpp_lib_jthread < 201911L || __cpp_lib_span < 202002L' \
    '#error too old' '#endif' | "$compiler" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null ||
    fail "$compiler $("$compiler" -dumpversion) does not know C++20: PUCK needs GCC 12 or later; \
install it and name it with CXX=g++-12"
}

# Only for a new build or changed presets: Ninja notices all other changes.
configure() {
  [ "$folder/build.ninja" -nt CMakePresets.json ] && return
  require_tools
  local is_new=true log
  [ ! -e "$folder" ] || is_new=false
  mkdir -p "$folder" 2>/dev/null && [ -w "$folder" ] ||
    fail "$PWD/$folder cannot be written: build in a clone that you own"
  if ! log=$(cmake --preset release 2>&1); then
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
NINJA_STATUS='@%f/%t@ ' cmake --build --preset release -j "$(nproc)" --target "$@" 2>&1 |
  show_progress
