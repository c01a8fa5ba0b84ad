"""Help: the pages of docs/ inside the window, found by F1, by an index and by search."""
