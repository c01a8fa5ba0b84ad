"""What a run does at each tick by itself, from its start to its goals."""
