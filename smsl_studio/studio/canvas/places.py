"""Places: where the states of each SB stand, steady from edit to edit and through undo.

What was dragged lies in the blueprint (``_layout``) and goes back with it. What was laid out
without being asked is remembered here, so that an edit never moves a state that nobody touched.
"""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.layout import place_states

Position = tuple[float, float]


class Places:
    """The automatic places of the states, by SB."""

    def __init__(self) -> None:
        self._placed: dict[str, dict[str, Position]] = {}
        self._order: dict[str, tuple[str, ...]] = {}

    def clear(self) -> None:
        """Forget everything: another file was opened."""
        self._placed.clear()
        self._order.clear()

    def of(self, branch: StateBranch) -> dict[str, Position]:
        """The place of every state of an SB now."""
        former = self._placed.get(branch.name)
        if former is None:
            former = self._first(branch)
        else:
            self._follow_rename(branch, former)
        places = place_states(branch, former)
        for name, place in places.items():
            former.setdefault(name, place)
        self._placed[branch.name] = former
        self._order[branch.name] = tuple(branch.table)
        return places

    def _first(self, branch: StateBranch) -> dict[str, Position]:
        """The automatic picture of an SB in which a few states were moved."""
        layout = branch.notes.layout
        kept = sum(name in branch.table for name in layout)
        if not kept or kept * 2 >= len(branch.table):
            return {}
        fields = {k: v for k, v in branch.fields.items() if k != "_layout"}
        return place_states(replace(branch, fields=fields))

    def _follow_rename(self, branch: StateBranch, former: dict[str, Position]) -> None:
        """States that were renamed, one or many at once, keep their places."""
        before, now = self._order[branch.name], tuple(branch.table)
        if len(before) != len(now):
            return
        gone, fresh = set(before) - set(now), set(now) - set(before)
        for old, new in zip(before, now, strict=True):
            if old in gone and new in fresh and old in former:
                former[new] = former[old]

    def rename_branch(self, before: str, after: str) -> None:
        """An SB that was renamed keeps its places."""
        if before in self._placed and after not in self._placed:
            self._placed[after] = dict(self._placed[before])
            self._order[after] = self._order[before]
