"""The panels around the canvas. Each knows only the session and the tokens."""
