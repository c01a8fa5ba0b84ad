"""Unsaved work and files that other programs change: no text is lost without a question."""
