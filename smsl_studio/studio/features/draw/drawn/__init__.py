"""Notes and groups on the drawing: their gestures as edits, their verbs and their menus."""
