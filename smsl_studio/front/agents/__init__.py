"""Automatic supervisors by name: those of plugins and three of our own, in a process of their own.

``run --supervisor NAME:key=value`` and ``run(..., supervisor="NAME")`` ask for them.
"""
