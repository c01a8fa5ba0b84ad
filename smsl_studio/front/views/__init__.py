"""What a run shows of itself, in rows and words, for whoever draws or prints it."""
