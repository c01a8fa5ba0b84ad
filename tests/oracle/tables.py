"""Clause 14: what the table world writes to its table, and when."""

from __future__ import annotations

from tests.oracle.situation import Json, Situation
from tests.oracle.standing import Configuration


class Table:
    """What should stand on the table, told by what was begun and injected."""

    def __init__(self, now: Situation) -> None:
        self._now = now
        self._stands: dict[str, str] | None = None
        self._edge = ""
        self._left = 0
        self._befalls = ""

    def begun(self, edge: str) -> None:
        """The function of an edge begins; it writes in its first tick, or when it has lasted."""
        self._edge, self._left = edge, self._now.world.get("lasts", {}).get(edge, 0)

    def cancelled(self) -> None:
        self._edge = ""

    def told(self, call: Json) -> None:
        """Something goes wrong on purpose."""
        if call[0] != "inject":
            return
        if call[1] == "set":
            if self._stands is not None:
                self._stands[call[2]["fact"]] = call[2]["value"]
        else:
            self._befalls = call[1]

    def passed(self, outcome: str, table: dict[str, str]) -> None:
        """A tick has passed: the table as it stands now."""
        if self._stands is None:
            self._stands = dict(table)
        if self._edge and self._left == 0:
            if self._befalls:
                self._stands = dict(table)
                self._befalls = ""
            else:
                self._stands.update(self._effect(self._edge))
            self._edge = ""
        elif self._edge:
            self._left -= 1
        if table != self._stands:
            said = self._now.agreed
            if any(kind == "operation" and word == "done" for kind, _, word in said):
                self._stands = dict(table)
                return
            wrong = {fact: value for fact, value in table.items() if self._stands[fact] != value}
            self._now.broken(14, f"the table has {wrong}")
            self._stands = dict(table)

    def _effect(self, edge: str) -> dict[str, str]:
        """The facts of the target, except sub digits; with load those of the subs' states too."""
        drawing = self._now.drawing
        name = edge.split("/", 1)[0]
        target = drawing.edges[edge][1]
        branch = drawing.branches[name]
        found = {f"{name}/{digit}": branch.facts[target][digit] for digit in branch.leaves}
        if drawing.kind(edge) == "load":
            falls, rises = drawing.changed_subs(edge)
            places: Configuration = {}
            for digit in (*falls, *rises):
                self._put(branch.subs[digit], digit in rises, places)
            for sub, state in places.items():
                below = drawing.branches[sub]
                found |= {f"{sub}/{digit}": below.facts[state][digit] for digit in below.leaves}
        return found

    def _put(self, name: str, on: bool, places: Configuration) -> None:
        branch = self._now.drawing.branches[name]
        places[name] = branch.activating if on else branch.initial
        for digit, sub in branch.subs.items():
            self._put(sub, branch.is_on(places[name], digit), places)
