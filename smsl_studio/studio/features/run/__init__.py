"""The run pane: a frozen blueprint under the dispatcher, seen from every side."""
