"""The edges of a blueprint by their effect on sub digits, and what each needs (clauses 2 and 5)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from .elements import Branch, Configuration, Edge, address, split_fact
from .hierarchy import Hierarchy

Extra = Callable[[Edge], float]


class Edges:
    """The edges of one blueprint, each made when it is first asked for.

    ``costs`` replace declared costs (by address). ``extra`` gives additional costs.
    """

    def __init__(
        self, hierarchy: Hierarchy, costs: Mapping[str, float], extra: Extra | None = None
    ) -> None:
        self.hierarchy = hierarchy
        self.blueprint = hierarchy.blueprint
        self._costs, self._extra = costs, extra
        self._out: dict[tuple[str, str], tuple[Edge, ...]] = {}

    def out(self, branch: str, state: str) -> tuple[Edge, ...]:
        """Return every edge out of a state, in written order."""
        found = self._out.get((branch, state))
        if found is None:
            own = self.blueprint[branch]
            found = tuple(
                self._edge(own, state, name, target)
                for name, target in own.states[state].operations.items()
            )
            self._out[branch, state] = found
        return found

    def get(self, branch: str, state: str, name: str) -> Edge:
        """Return one edge, which must exist."""
        return next(edge for edge in self.out(branch, state) if edge.name == name)

    def missing(self, edge: Edge, configuration: Configuration) -> Iterator[str]:
        """Yield a sentence for each fact that an edge requires and a configuration has not."""
        for name, digit, value in edge.requires:
            if digit < 0:
                yield f"{edge} requires {name}, which is no fact"
                continue
            held = self.blueprint[name].facts(configuration[name])[digit]
            if held != value:
                yield f"{edge} requires {name}/{digit} to be {value}, and it is {held}"

    def requiring(self, branch: str) -> set[str]:
        """Return the SBs whose facts operations of an SB require."""
        return {
            name
            for terms in self.blueprint[branch].operations.values()
            for name, digit, _ in self._required(terms.requires)
            if digit >= 0
        }

    def _edge(self, own: Branch, source: str, name: str, target: str) -> Edge:
        terms = own.operation(source, name)
        pairs = enumerate(zip(own.facts(source), own.facts(target), strict=True))
        changed = [digit for digit, (before, after) in pairs if before != after]
        subs = [digit for digit, _ in self.hierarchy.subs[own.name]]
        turned = [d for d in subs if own.is_on(source, d) != own.is_on(target, d)]
        falls = tuple(d for d in turned if own.is_on(source, d))
        rises = tuple(d for d in turned if own.is_on(target, d))
        others = any(digit not in subs for digit in changed)
        kind = _kind(falls, rises, others)
        load = terms.load and bool(turned)
        acts = load or kind == "pure" or others
        enters = (target == own.activating) - (source == own.activating)
        price = self._costs.get(address(own.name, source, name), terms.cost)
        cost = 0.0 if kind in ("rise", "fall") and not acts else price
        fails = own.failing.get(target, "") if source not in own.failing else ""
        made = Edge(
            branch=own.name,
            source=source,
            name=name,
            target=target,
            terms=terms,
            kind=kind,
            falls=falls,
            rises=rises,
            crossing=enters if self.hierarchy.bases[own.name] else 0,
            load=load,
            acts=acts,
            cost=cost,
            price=price,
            requires=tuple(self._required(terms.requires)),
            fails=fails,
        )
        extra = self._extra(made) if self._extra else 0.0
        return replace(made, cost=cost + extra, price=price + extra) if extra else made

    def _required(self, requires: Mapping[str, str]) -> Iterator[tuple[str, int, str]]:
        for key, value in requires.items():
            name, digit = split_fact(key) or (key, -1)
            known = self.blueprint.branches.get(name)
            if known is None or digit >= len(known.flags):
                yield key, -1, value
            else:
                yield name, digit, value


def _kind(falls: tuple[int, ...], rises: tuple[int, ...], others: bool) -> str:
    turned = len(falls) + len(rises)
    if not turned:
        return "pure"
    if turned > 1 or others:
        return "mixed"
    return "rise" if rises else "fall"
