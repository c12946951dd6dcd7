#!/usr/bin/env bash
# The paper's experiment and more in one command: makes sequences of the simulated game, runs all
# presets and the baselines over them, and writes tables, JSON and the paper's figures.
#
#   tools/compare.sh [--sequences N] [--seconds S] [--only NAME[,NAME...]] [--scoring ours|paper]
#                    [--output DIR] [--jobs J] [--keep]
#
# --sequences N  with the still and with the moving camera each, 1 to 20 (default 10), and half as many
#                of each hard scene in tools/compare/scenes
# --seconds S    length of each (default 30); the hard ones are a third as long, 2 to 10 s
# --only NAMES   these presets and baselines alone, and without the ablation of default
# --scoring R    by our rules (default) or by those of the paper's authors: see puck-evaluate --help
# --output DIR   where everything goes (default build/compare): comparison.txt, comparison.md,
#                comparison.json and the figures as PNG. DIR/results holds what has been run already,
#                so that another run does only what has changed
# --jobs J       sequences worked on at a time (default: one a core)
# --keep         do not delete each recording after everything has run on it (3 GB)
#
# Seeds: 1 to 99 are for development, parameters are chosen on them only. The puck's size and the
# sensor's lag are calibrated on seed 1, latency is measured on seed 2. For testing: still from 1001,
# moving from 1101, hard scenes from 1201, 1211, 1221 and so on. No tracker gets truth, its start
# included.
#
# All of it takes some 40 minutes on two cores, without the particle filter and the ablation a
# quarter of an hour, and --sequences 2 --seconds 5 less than two minutes.
set -euo pipefail
root=$(CDPATH='' cd "$(dirname "$0")/.." && pwd)

for option in "$@"; do
  if [ "$option" = -h ] || [ "$option" = --help ]; then
    sed -n '2,/^set /s/^# \{0,1\}//p' "$0" | sed '/^set /d'
    exit 0
  fi
done

"$root/tools/build.sh" puck-simulate puck-calibrate puck-evaluate puck-compare
exec "$root/build/release/bin/puck-compare" \
  --scenes "$root/tools/compare/scenes" --output "$root/build/compare" "$@"
