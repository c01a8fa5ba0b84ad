"""The rows of the table of actions that concern the drawing, one file for each menu."""
