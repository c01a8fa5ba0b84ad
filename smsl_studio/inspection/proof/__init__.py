"""Proof: shows whether hazards and properties hold, over the configurations of a blueprint."""
