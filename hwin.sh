. /tmp/w/g1w/env.sh
[ -f /tmp/w/g1w/win.pid ] && kill $(cat /tmp/w/g1w/win.pid) 2>/dev/null; sleep 1
SMSL_STUDIO_HOME=/tmp/w/g1w/homeD nohup $S open $1 --mode $2 > /tmp/w/g1w/win.log 2>&1 & echo $! > /tmp/w/g1w/win.pid
for i in $(seq 60); do sleep 1; W=$(xdotool search --onlyvisible --name "SMSL Studio" 2>/dev/null | tail -1); [ -n "$W" ] && break; done
sleep 6; xdotool windowsize $W 1280 780; xdotool windowmove $W 0 0; xdotool windowactivate $W; sleep 3
