"""The two-way source pane: the exact text, typed in as in any editor, one with the graph.

``pane`` is what the window shows. It puts ``editor`` (the text itself) together with the lines
above and below it. Files that import no Qt hold what can be said without a widget.
"""
