"""LowPage: shows the world and the timeline as tabs if the run page is very low.

So nothing lies below the edge of the window.
"""

from __future__ import annotations

from PySide6.QtWidgets import QSplitter, QWidget

from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.tabs import Tabs

LOWEST = 430
"""In a run page lower than this, the drawing stands beside tabs (pixels)."""
NARROW = 200
"""The least width of the drawing beside the tabs (pixels)."""
WORLD, TIMELINE = "World", "Timeline"


class LowPage:
    """Moves the world and the timeline from their splitters into the tabs, and back.

    ``homes`` has the world and the timeline, each with its splitter in a higher page. ``drawing``
    is beside the tabs.
    """

    def __init__(
        self, lists: Tabs, drawing: QWidget, homes: tuple[tuple[QWidget, QSplitter], ...]
    ) -> None:
        self._lists, self._drawing, self.tabbed = lists, drawing, False
        self._homes = tuple(
            (name, part, splitter, splitter.indexOf(part))
            for name, (part, splitter) in zip((WORLD, TIMELINE), homes, strict=True)
        )
        self._wide = drawing.minimumWidth()
        self._sizes: list[list[int]] = []

    def fit(self, height: int) -> None:
        """Arrange the parts of a run page for its height (pixels)."""
        tabbed = height < LOWEST
        if tabbed == self.tabbed:
            return
        self.tabbed = tabbed
        self._lists.set_close(tabbed)
        self._lists.leave_out_tools(tabbed)
        self._drawing.setMinimumWidth(NARROW if tabbed else self._wide)
        if tabbed:
            self._sizes = [splitter.sizes() for _, _, splitter, _ in self._homes]
            for name, part, _, _ in self._homes:
                page, column = empty_panel()
                column.addWidget(part)
                self._lists.add(name, page)
            return
        for (name, part, splitter, at), sizes in zip(self._homes, self._sizes, strict=True):
            splitter.insertWidget(at, part)
            part.show()
            self._lists.remove(name)
            splitter.setSizes(sizes)
