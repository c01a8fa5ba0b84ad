"""The tour: the first steps, done by the person in the real window on a copy of a sample."""
