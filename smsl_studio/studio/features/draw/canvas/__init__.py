"""The editor of the canvas: its gestures become edits of the session."""
