"""Runs a blueprint, one D-SFO step at a time, from the partial view. It has no thread, Qt, clock or
file.
"""
