"""A drawing from a planning problem in PDDL."""
