"""The journal: unsaved work, written to the disk within a second, so that a crash does not lose it.

While a window has unsaved work, it keeps one file in the folder ``journal`` of the user's folder.
``entry`` is the content of the file. ``place`` is the file with the lock that shows that its window
is alive. ``writer`` keeps it up to date. ``leftovers`` finds the journals of windows that have
crashed.
"""
