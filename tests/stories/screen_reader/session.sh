#!/bin/sh
# One desktop session: a bus, a window on the display given, and the walker that reads it.
# session.sh PYTHON FILE WALKS OUT; ends with 99 where the window died under the walk.
set -u
here=$(dirname "$0")
"$1" -X faulthandler -m smsl_studio open "$2" &
window=$!
/usr/bin/python3 "$here/walker.py" "$window" "$3" "$4"
walked=$?
kill -0 "$window" 2>/dev/null || exit 99
kill "$window"
wait "$window"
exit "$walked"
