#!/bin/sh
# sum_precompiled.sh COMPILER ARGUMENT... -o OUTPUT ...
#
# Compiles, and writes the checksum of a precompiled header beside it, as OUTPUT.sum. With
# CCACHE_PCH_EXTSUM ccache reads that for each file that is compiled with the header, instead of the
# header's own 90 MB. While there is none it reads the header, so that an old one must not stay.
set -eu

is_output=false
output=
for argument; do
  if $is_output; then output=$argument; fi
  if [ "$argument" = -o ]; then is_output=true; else is_output=false; fi
done

case "$output" in
  *.gch | *.pch) ;;
  *) exec "$@" ;;
esac
rm -f "$output.sum"
"$@"
# In one step, since half a checksum might be that of other headers, too.
if sha256sum <"$output" >"$output.sum.new"; then
  mv "$output.sum.new" "$output.sum"
else
  rm -f "$output.sum.new"
fi
