#!/usr/bin/env bash
# Tests the page of puck-view in Debian's Chromium, headless, driven by its chromedriver.
#
#   tests/browser/run.sh [TEST...]     such as RecordedPage.test_keys_pause_seek_and_step; default: all
#
# Installs what is missing and builds. Exit status 1 when a test failed.
set -euo pipefail
CDPATH='' cd "$(dirname "$0")/../.."
tools/install-deps.sh --browser
tools/build.sh puck-{arm,bridge,camera,doctor,logger,tracker,view}
cd tests/browser
tests=(page_test)
[ $# -eq 0 ] || tests=("${@/#/page_test.}")
# Debian's, which has the packages installed above.
/usr/bin/python3 -m unittest "${tests[@]}"
