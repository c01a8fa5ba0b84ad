"""Unsaved work, and what other programs do to the files: nothing is lost without a question."""
