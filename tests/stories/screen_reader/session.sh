#!/bin/sh
# One desktop session: a bus, a window on the display given, and the walker that reads it.
# session.sh PYTHON FILE WALKS OUT WINDOW; WINDOW is a module and its arguments. Ends with 99
# where the window died under the walk.
set -u
here=$(dirname "$0")
# shellcheck disable=SC2086
"$1" -X faulthandler -m $5 "$2" &
window=$!
/usr/bin/python3 "$here/walker.py" "$window" "$3" "$4"
walked=$?
kill "$window" 2>/dev/null
wait "$window"
ended=$?
# Of its own accord, or by the kill above (128 + 15); all else was a death.
[ "$ended" -eq 0 ] || [ "$ended" -eq 143 ] || exit 99
exit "$walked"
