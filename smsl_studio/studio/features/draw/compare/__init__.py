"""The compare view: two versions side by side, and a list of the changes in words."""
