"""The edges that go along with a crossing: one of every base, and of their bases (clauses 5 and
10).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from smsl_studio.blueprint.configuration import Configuration
from smsl_studio.blueprint.edges import Edge, EdgeKind, Edges
from smsl_studio.blueprint.joint import Carried
from smsl_studio.blueprint.terms import Terms

Held = Mapping[str, Carried]
"""For each SB the base edge that is being carried out."""


class Unavailable(Exception):  # noqa: N818 -- an answer, not an error of ours
    """An edge cannot be carried out from a configuration. ``reasons`` are sentences. ``hazard`` is
    the name of the hazard that it would meet, if that is the reason.
    """

    def __init__(self, *reasons: str, hazard: str = "") -> None:
        super().__init__("; ".join(reasons))
        self.reasons, self.hazard = reasons, hazard


def allow(edges: Edges, terms: Terms, configuration: Configuration, edge: Edge) -> None:
    """Raise Unavailable if an edge alone must not be used from a configuration."""
    reasons = list(terms.closures(edge))
    if edge.requires:
        reasons.extend(edges.missing(edge, configuration))
    if reasons:
        raise Unavailable(*reasons)


class Along:
    """Finds the edges of bases. ``allow`` raises Unavailable for an edge that must not be used."""

    def __init__(self, edges: Edges, allow: Callable[[Configuration, Edge], None]) -> None:
        self._edges = edges
        self._hierarchy = edges.hierarchy
        self._allow = allow

    def edges_for(
        self, configuration: Configuration, edge: Edge, places: Mapping[str, str], held: Held
    ) -> tuple[Edge, ...]:
        """Return the edges of bases that go along with a crossing, nearest base first.

        Raises Unavailable if a base has no such edge.
        """
        taken = {name: carried.edge for name, carried in held.items()}
        taken[edge.branch] = edge
        before = len(taken)
        if edge.crossing:
            self._take(configuration, edge.branch, edge.crossing, taken, {})
        for sub, state in places.items():
            crossing = self.crossing(configuration, sub, state)
            if crossing:
                self._take(configuration, sub, crossing, taken, {**places, edge.branch: ""})
        return tuple(taken.values())[before:]

    def crossing(self, configuration: Configuration, sub: str, state: str) -> int:
        """Return 1 if a sub-SB would enter its ACTIVATING state, -1 if it would leave it, else
        0.
        """
        activating = self._hierarchy.blueprint[sub].activating
        return (state == activating) - (configuration[sub] == activating)

    def _take(
        self,
        configuration: Configuration,
        sub: str,
        crossing: int,
        taken: dict[str, Edge],
        loaded: Mapping[str, str],
    ) -> None:
        kind = EdgeKind.RISE if crossing > 0 else EdgeKind.FALL
        for base, digit in self._hierarchy.bases[sub]:
            if base in loaded:
                continue
            if base in taken:
                moving = taken[base]
                if digit in (moving.rises if crossing > 0 else moving.falls):
                    continue
                fact = self._fact(base, digit)
                raise Unavailable(f"{moving} is no {kind.value} of {fact} for {sub}")
            reasons: list[str] = []
            for edge in self._singles(kind, base, configuration[base], digit):
                attempt = {**taken, base: edge}
                try:
                    self._allow(configuration, edge)
                    if edge.crossing:
                        self._take(configuration, base, edge.crossing, attempt, loaded)
                except Unavailable as no:
                    reasons.extend(no.reasons)
                    continue
                taken.clear()
                taken.update(attempt)
                break
            else:
                here = f"{base}/{configuration[base]}"
                fact = self._fact(base, digit)
                words = f"{here} has no {kind.value} of {fact} for {sub} to take along"
                raise Unavailable(words, *reasons)

    def _fact(self, base: str, digit: int) -> str:
        """Return the words for a fact: its name with the digit, or the digit alone."""
        note = self._hierarchy.blueprint[base].fact_note(digit)
        return f"{note.name} (digit {digit})" if note and note.name else f"digit {digit}"

    def _singles(self, kind: EdgeKind, base: str, state: str, digit: int) -> list[Edge]:
        """Return the pure rises or falls of one digit, cheapest first, without ``load`` edges."""
        found = (
            edge
            for edge in self._edges.out(base, state)
            if edge.kind is kind and digit in (*edge.rises, *edge.falls) and not edge.load
        )
        return sorted(found, key=lambda edge: (edge.price, edge.name))
