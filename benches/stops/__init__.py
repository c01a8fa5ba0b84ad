"""What the bench ``stopping`` starts: inputs that last, and programs that are stopped meanwhile."""
