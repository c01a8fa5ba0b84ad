"""Run mode: one run with its canvas, world, facts, possible operations and timeline."""
