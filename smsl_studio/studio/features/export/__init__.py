"""Pictures and diagrams of the drawing: as files, on the clipboard, on paper."""
