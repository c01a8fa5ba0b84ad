"""The run that a window shows, and the widgets about it that several features share."""
