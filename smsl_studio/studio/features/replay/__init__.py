"""Replay: a recorded run is shown again from its log. Nothing can be commanded."""
