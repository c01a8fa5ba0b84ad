"""Rules from examples: what the edges of a blueprint, or of runs, have in common."""
