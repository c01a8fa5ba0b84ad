"""The record of a run: one stream of frozen events. The log, the window, the timeline and tests
read it.
"""
