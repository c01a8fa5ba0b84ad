"""What happened: one stream of frozen events that file, highlight, timeline and tests read."""
