"""The picture of a world: its camera, its drawing from poses, and the widget that shows it."""
