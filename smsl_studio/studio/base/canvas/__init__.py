"""The canvas as a view: one SB as a picture of states and operations, and the gestures on it.

``Canvas`` is the view. It tells with signals what a gesture asks for, and edits nothing.
"""
