"""The run that a window shows, and whatever else several features share."""
