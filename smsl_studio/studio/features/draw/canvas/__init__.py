"""The editor of the canvas: it turns gestures into edits of the session."""
