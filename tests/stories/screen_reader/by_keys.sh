#!/bin/sh
# A window in a session of its own, in which by_keys.py works by keys alone: by_keys.sh PYTHON FILE
set -u
"$1" -X faulthandler -m smsl_studio open &
window=$!
/usr/bin/python3 -m tests.stories.screen_reader.by_keys "$window" "$2"
done=$?
kill "$window" 2>/dev/null
wait "$window"
exit "$done"
