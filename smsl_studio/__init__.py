"""SMSL Studio: draw, inspect and run blueprints of medical and robotic procedures."""
