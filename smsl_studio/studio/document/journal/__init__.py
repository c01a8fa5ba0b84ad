"""The journal: unsaved work, on the disk within a second, so that no crash takes it along.

Each window keeps one file in the ``journal`` folder of the user's folder while it holds unsaved
work. ``entry`` is what stands in it, ``place`` the file and the lock that says that its window
lives, ``writer`` keeps it up to date, ``leftovers`` reads what windows have left behind.
"""
