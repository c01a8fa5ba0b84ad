"""The rows of the action table for drawing, one file for each menu."""
