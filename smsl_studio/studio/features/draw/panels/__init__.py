"""The panels around the canvas: each knows only the session and the tokens."""
