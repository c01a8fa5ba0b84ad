"""The canvas shows one SB as a picture of states and operations, and takes the mouse and keys.

``Canvas`` is the view. It reports what the user asks for by signals, and edits nothing itself.
"""
