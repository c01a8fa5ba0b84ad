#!/bin/sh
# A virtual screen and a bus with a window on a file, for reader.py: desk.sh PYTHON FILE FOLDER.
# It stays until it is ended (Ctrl+C or kill). FOLDER/env has what a shell sources to reach them:
#     . FOLDER/env && /usr/bin/python3 -m tests.stories.screen_reader.reader tree
set -eu
python=$1 file=$2 folder=$3
mkdir -p "$folder"
mkfifo "$folder/display"
Xvfb -displayfd 3 -screen 0 1440x900x24 -nolisten tcp 3>"$folder/display" 2>/dev/null &
screen=$!
read -r number <"$folder/display"
rm "$folder/display"
export DISPLAY=":$number" QT_QPA_PLATFORM=xcb QT_LINUX_ACCESSIBILITY_ALWAYS_ON=1
export SMSL_STUDIO_HOME="$folder/home"
trap 'kill "$screen"' EXIT
trap 'exit 0' INT TERM
dbus-run-session -- sh -c '
    printf "export DISPLAY=%s DBUS_SESSION_BUS_ADDRESS=%s\n" \
        "$DISPLAY" "$DBUS_SESSION_BUS_ADDRESS" >"$3/env"
    "$1" -m smsl_studio open "$2"' desk "$python" "$file" "$folder"
