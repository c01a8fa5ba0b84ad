"""Blueprints that are worked out instead of drawn: from the rules of a procedure."""
