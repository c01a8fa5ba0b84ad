"""Supervise mode: what a responsible person sees of a run, and what they may do about it."""
