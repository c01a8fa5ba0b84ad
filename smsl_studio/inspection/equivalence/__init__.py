"""Equivalence: whether two blueprints behave alike, and a run that tells them apart if not."""
