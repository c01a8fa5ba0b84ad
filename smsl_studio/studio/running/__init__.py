"""The run that a window shows: the session of it, and the widgets that several features share."""
