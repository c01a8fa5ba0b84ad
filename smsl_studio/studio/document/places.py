"""Places: where the states of each SB stand. They stay the same through edits and undo.

Places of dragged states are in the blueprint (``_layout``), so undo restores them. Automatic places
are remembered here, so that an edit never moves a state that nobody moved.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import compress, filterfalse
from operator import ne

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.arrangement import MOST_STATES, names_of
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.layout import is_placed, is_slow, place_states

Position = tuple[float, float]
Names = tuple[dict[str, str], set[str]]
"""The names that an edit changed, each with its new name, and the new ones."""


class Places:
    """The automatic places of the states (scene units), by SB and state."""

    def __init__(self) -> None:
        self._placed: dict[str, dict[str, Position]] = {}
        self._order: dict[str, tuple[str, ...]] = {}

    def clear(self) -> None:
        """Forget all places, because another file was opened."""
        self._placed.clear()
        self._order.clear()

    def of(self, branch: StateBranch) -> dict[str, Position]:
        """The places of all states of an SB; new ones are remembered."""
        former = self._placed.get(branch.name)
        if former is None:
            former = {}
        else:
            self._follow_rename(branch, former)
        places = place_states(branch, former)
        new = list(filterfalse(former.__contains__, places))
        former.update(zip(new, map(places.__getitem__, new), strict=True))
        self._placed[branch.name] = former
        self._order[branch.name] = tuple(branch.table)
        return places

    def shown(self, branch: StateBranch) -> dict[str, Position]:
        """The places of all states for another view, without remembering new ones."""
        return place_states(branch, self._placed.get(branch.name))

    def moved(
        self, blueprint: Blueprint, branch: str, positions: Mapping[str, Position]
    ) -> Blueprint:
        """The blueprint with states of an SB at other places. Bends between states that move by the
        same way go along."""
        bent = bool(blueprint[branch].notes.edges)
        former = self.of(blueprint[branch]) if bent else None
        return editing.set_layout(blueprint, branch, positions, former)

    def completed(self, before: Blueprint, after: Blueprint) -> Blueprint:
        """``after`` with written places, for every SB that a newly opened file would show
        differently.

        That is so if an edit placed some states by hand, or changed the shape on which the layout
        depends. Then the places of all states of the SB are written. They are also written if an
        operation is bent, because its bends belong to these places.
        """
        self._follow_branch(before, after)
        for name, branch in after.branches.items():
            former, layout = before.branches.get(name), branch.notes.layout
            if former is branch:
                continue
            missing = branch.table.keys() - layout.keys()
            bent = _is_bent(former, branch)
            if not missing:
                continue
            if former is not None:
                names = _renamed(tuple(former.table), tuple(branch.table))
                held = self._held(former, branch, names)
                if held:
                    after = editing.set_layout(after, name, held)
                if held or (not bent and _laid_out_alike(former, branch, names)):
                    self._follow_names(branch)
                    continue
            kept = former is not None and set(layout.values()) <= set(former.notes.layout.values())
            places = self.of(branch)
            # Nobody waits for a layout that would most likely be another one.
            anew = (layout and not kept) or is_slow(branch) or not is_placed(branch, places)
            if bent or anew:
                rest = {state: places[state] for state in branch.table if state in missing}
                after = editing.set_layout(after, name, rest)
        return after

    def _follow_branch(self, before: Blueprint, after: Blueprint) -> None:
        """Keep the places of an SB that an edit renamed."""
        if len(before) == len(after):
            for old, new in zip(before.branches, after.branches, strict=True):
                if old not in after.branches and old in self._placed:
                    self.rename_branch(old, new)

    def _follow_names(self, branch: StateBranch) -> None:
        """Note the names of an SB now. It may be renamed again before anybody looks at it."""
        if branch.name in self._placed:
            self._follow_rename(branch, self._placed[branch.name])
            self._order[branch.name] = tuple(branch.table)

    def _held(self, before: StateBranch, after: StateBranch, names: Names) -> dict[str, Position]:
        """The places to write, so that a renamed state stays where it stands.

        Its new name may be remembered at another place, which a deleted state comes back to. Then
        the places of all states without a written one are returned, else none.
        """
        remembered = self._placed.get(before.name, {})
        were, are = names
        if len(before.table) != len(after.table) or remembered.keys().isdisjoint(are):
            return {}
        places = self.of(before)
        if all(remembered.get(now, places[was]) == places[was] for was, now in were.items()):
            return {}
        layout = after.notes.layout
        stand = {were.get(state, state): place for state, place in places.items()}
        return {state: place for state, place in stand.items() if state not in layout}

    def _follow_rename(self, branch: StateBranch, former: dict[str, Position]) -> None:
        """Keep the places of states that were renamed, one or many."""
        before, now = self._order[branch.name], tuple(branch.table)
        if len(before) != len(now):
            return
        were, are = _renamed(before, now)
        for old, new in were.items():
            if old not in are and new not in were and old in former:
                former.setdefault(new, former[old])

    def rename_branch(self, before: str, after: str) -> None:
        """Keep the places of an SB that was renamed."""
        if before in self._placed and after not in self._placed:
            self._placed[after] = dict(self._placed[before])
            self._order[after] = self._order[before]


def _is_bent(before: StateBranch | None, after: StateBranch) -> bool:
    """Whether an edit gave an operation other bends."""
    drawn = after.notes.edges
    had = before.notes.edges if before is not None else {}
    return drawn is not had and any(
        layout.bends and (edge not in had or had[edge].bends != layout.bends)
        for edge, layout in drawn.items()
    )


def _laid_out_alike(a: StateBranch, b: StateBranch, names: Names) -> bool:
    """Whether everything that a layout depends on is equal.

    Comparing two layouts themselves would be too slow.
    """
    if a is b:
        return True
    # A name that stood at another place is remembered there.
    were, are = names
    if _ends(a) != _ends(b) or not were.keys().isdisjoint(are):
        return False
    one, other = a.notes.layout, b.notes.layout
    if (one or other) and list(map(one.get, a.table)) != list(map(other.get, b.table)):
        return False
    if not graph_of(a).is_like(graph_of(b)):
        return False
    # It would take long to find small parts of a large SB, which alone depend on names.
    return len(b.table) > MOST_STATES or names_of(a) == names_of(b)


def _renamed(before: tuple[str, ...], now: tuple[str, ...]) -> Names:
    """The names of states that changed, each with its new name, and the new ones."""
    pairs = dict(compress(zip(before, now, strict=False), map(ne, before, now)))
    return pairs, set(pairs.values())


def _ends(branch: StateBranch) -> tuple[int | None, int | None]:
    """INITIAL and ACTIVATING by number."""
    index = graph_of(branch).index
    return index.get(branch.initial), index.get(branch.activating)
