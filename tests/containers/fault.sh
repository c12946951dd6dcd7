#!/bin/sh
# Spoils the network of the container whose network it shares, for as long as that lives. Needs
# CAP_NET_ADMIN.
#
#   fault.sh none             leaves it as it is
#   fault.sh loss PERCENT     drops so many of the datagrams that come in, at random
#   fault.sh narrow MBIT_S    sends what goes out through a link of that rate
set -eu
case "${1-} ${2-}" in
  "none ") ;;
  "loss "[0-9]*)
    nft "add table ip fault; \
      add chain ip fault input { type filter hook input priority 0; }; \
      add rule ip fault input meta l4proto udp numgen random mod 100 < $2 counter drop"
    ;;
  "narrow "[0-9]*)
    tc qdisc add dev eth0 root tbf rate "${2}mbit" burst 32k latency 50ms
    ;;
  *)
    sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d' >&2
    exit 2
    ;;
esac
