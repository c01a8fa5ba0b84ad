"""The map of branches: all SBs of the file as cards, and which fact leads to which sub-SB."""
