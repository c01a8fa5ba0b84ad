"""The source pane: the exact text of the files, edited as in any editor, in step with the graph.

``pane`` is the widget that the window shows. It combines ``editor`` (the text) with the lines above
and below it. The modules without Qt hold the logic that needs no widget.
"""
