"""The explorer: all configurations of a blueprint together, as it moves and as it could move."""
