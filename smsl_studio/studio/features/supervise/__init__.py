"""Supervise mode: what a responsible person sees of a run, and what they can do about it."""
