"""Supervision: what people and agents may say to a run, in which run state, and what it does."""
