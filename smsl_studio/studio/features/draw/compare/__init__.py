"""The compare view: two versions side by side, and what changed between them in words."""
