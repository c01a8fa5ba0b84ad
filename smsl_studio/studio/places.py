"""Places: where the states of each SB stand, steady from edit to edit and through undo.

What was dragged lies in the blueprint (``_layout``) and goes back with it. What was laid out
without being asked is remembered here, so that an edit never moves a state that nobody touched.
"""

from __future__ import annotations

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint, StateBranch
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
            former = {}
        else:
            self._follow_rename(branch, former)
        places = place_states(branch, former)
        for name, place in places.items():
            former.setdefault(name, place)
        self._placed[branch.name] = former
        self._order[branch.name] = tuple(branch.table)
        return places

    def shown(self, branch: StateBranch) -> dict[str, Position]:
        """The place of every state as another view shows it: the same, and nothing is kept."""
        return place_states(branch, self._placed.get(branch.name))

    def completed(self, before: Blueprint, after: Blueprint) -> Blueprint:
        """``after`` with the places of all states of an SB in which an edit placed some by hand.

        With one place written alone, the file would be laid out anew around it when it is opened.
        """
        for name, branch in after.branches.items():
            layout = branch.notes.layout
            missing = branch.table.keys() - layout.keys()
            if not layout or not missing:
                continue
            former = before.branches.get(name)
            if former is not None and set(layout.values()) <= set(former.notes.layout.values()):
                continue
            places = self.of(branch)
            rest = {state: places[state] for state in branch.table if state in missing}
            after = editing.set_layout(after, name, rest)
        return after

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
