"""Blueprints that are computed from the rules of a procedure instead of drawn."""
