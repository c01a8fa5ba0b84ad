"""The document of a window: its session, its files, its findings, and the journal of unsaved
work."""
