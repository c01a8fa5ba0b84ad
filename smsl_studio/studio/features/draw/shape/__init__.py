"""Changes the shape of a blueprint and keeps its behaviour.

A change is computed, shown as a preview of both sides, and then made.
"""
