"""What the bench ``bombs`` starts: the real program on one file, its time and memory taken."""
