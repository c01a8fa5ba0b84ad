"""Blueprints from planning problems in PDDL: reading, grounding, and all states breadth first."""
