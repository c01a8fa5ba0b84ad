"""The D-SFO engine: it carries out any blueprint. What is of this blueprint stands beside it."""
