"""The files of a window: opening, saving, converting, and comparing them with the disk."""
