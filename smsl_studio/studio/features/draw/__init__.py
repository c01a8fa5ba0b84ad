"""Draw mode: the canvas with its editor, the panels, the source editor, comparison and search."""
