"""When an edge may be used, and which edges of base SBs move with it: clauses 4, 5 and 10."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from tests.oracle.drawing import DEFAULT_COST, Drawing
from tests.oracle.standing import Configuration

Chain = tuple[str, ...]
"""Edges of bases that are under way, the nearest last."""


@dataclass
class Terms:
    """Under which terms edges may be used now: what is shut, what costs otherwise, what is bound.

    ``shut`` are edges that are avoided or pruned, ``bypassed`` those that routes go around as
    well (risky, vetoed). ``unbound`` edges have no function, ``exact`` ones have one bound to
    exactly them.
    """

    drawing: Drawing
    shut: frozenset[str] = frozenset()
    bypassed: frozenset[str] = frozenset()
    costs: Mapping[str, float] = field(default_factory=dict)
    unbound: frozenset[str] = frozenset()
    exact: frozenset[str] = frozenset()
    memory: dict[tuple[object, ...], object] = field(default_factory=dict)

    def cost(self, edge: str) -> float:
        """What was said during the run, else what is declared, else 1."""
        said = self.costs.get(edge)
        if said is None:
            said = self.drawing.note(edge).get("cost", DEFAULT_COST)
        return float(said)

    def own_function(self, edge: str) -> bool:
        """Clause 5: whether the edge's own function runs."""
        kind = self.drawing.kind(edge)
        if kind in ("pure", "load") or self.drawing.changes_leaf(edge):
            return True
        return edge in self.exact

    def required(self, edge: str, here: Configuration) -> bool:
        """Whether what an edge requires holds in a planned configuration."""
        for fact, value in self.drawing.note(edge).get("requires", {}).items():
            name, digit = fact.rsplit("/", 1)
            if self.drawing.value(here[name], name, int(digit)) != value:
                return False
        return True

    def usable(self, edge: str, here: Configuration, asked: bool) -> bool:
        """Clause 4 as far as it can be planned; ``asked``: a person asks for this very edge."""
        if edge in self.shut or (edge in self.bypassed and not asked):
            return False
        by_hand = self.drawing.level(edge) == "human"
        if self.own_function(edge) and edge in self.unbound and not by_hand:
            return False
        if not asked and self.breaks(edge):
            return False
        return self.required(edge, here)

    def breaks(self, edge: str) -> bool:
        """Whether an edge leads from a state without failure into a failure state."""
        branch = self.drawing.branches[edge.split("/", 1)[0]]
        source, target = self.drawing.edges[edge]
        return branch.fails(target) and not branch.fails(source)


def taken_along(
    terms: Terms, edge: str, here: Configuration, chain: Chain
) -> tuple[str, ...] | None:
    """Clause 10: the pure rise or fall of every base, and of their bases; None where one has
    none."""
    drawing = terms.drawing
    name = edge.split("/", 1)[0]
    found: list[str] = []
    rises = drawing.edges[edge][1] == drawing.branches[name].activating
    for base, digit in drawing.bases[name]:
        taken = with_base(terms, base, digit, rises, here, chain)
        if taken is None:
            return None
        found += taken
    return tuple(found)


def with_base(
    terms: Terms, base: str, digit: int, rises: bool, here: Configuration, chain: Chain
) -> tuple[str, ...] | None:
    """The edges that go along in one base and its own bases; empty where an edge of it is under
    way that changes this very digit in this way."""
    drawing = terms.drawing
    for under_way in chain:
        if under_way.split("/", 1)[0] == base:
            return () if digit in drawing.changed_subs(under_way)[1 if rises else 0] else None
    for chosen in _by_cost(terms, base, digit, rises, here):
        if not drawing.is_crossing(chosen):
            return (chosen,)
        further = taken_along(terms, chosen, here, (*chain, chosen))
        if further is not None:
            return (chosen, *further)
    return None


def _by_cost(terms: Terms, base: str, digit: int, rises: bool, here: Configuration) -> list[str]:
    """The pure rises or falls of a base on a digit: the cheapest by its own cost first, then by
    name."""
    drawing = terms.drawing
    branch = drawing.branches[base]
    found = [
        (terms.cost(edge), edge)
        for edge in (f"{base}/{here[base]}/{op}" for op in branch.states[here[base]])
        if drawing.kind(edge) == ("rise" if rises else "fall")
        and (digit in drawing.changed_subs(edge)[1 if rises else 0])
        and terms.usable(edge, here, False)
    ]
    return [edge for _, edge in sorted(found)]
