"""The map of branches: a card for each SB of the file, and a line from each fact to its sub-SB."""
