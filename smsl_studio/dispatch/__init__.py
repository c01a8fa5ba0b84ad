"""Partial view, during: one D-SFO step at a time. No thread, no Qt, no clock, no file."""
