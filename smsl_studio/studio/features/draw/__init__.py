"""Drawing a blueprint: the canvas with its editor, the panels, the source, files and search."""
