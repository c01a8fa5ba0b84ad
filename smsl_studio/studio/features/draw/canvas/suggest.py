"""Suggests names and targets for new operations, from what equal names do in the SB."""

from __future__ import annotations

from collections import Counter

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.names import fresh_operation_name

Effect = tuple[tuple[int, str], ...]
MOST_EDGES = 20_000


class Suggestions:
    """What the operations of an SB change in its facts, by majority (as rule R15 counts it)."""

    def __init__(self, branch: StateBranch) -> None:
        self._branch = branch
        self._uses: Counter[str] = Counter()
        effects: dict[str, Counter[Effect]] = {}
        known = {name: branch.facts(name) for name in branch.table}
        for edge in branch.edges() if branch.edge_count <= MOST_EDGES else ():
            self._uses[edge.name] += 1
            if edge.target in known:
                effect = _effect(known[edge.source], known[edge.target])
                effects.setdefault(edge.name, Counter())[effect] += 1
        self._known = known
        self._majority: dict[str, Effect] = {}
        for name, counts in effects.items():
            effect, count = counts.most_common(1)[0]
            if effect and count * 2 > counts.total():
                self._majority[name] = effect

    def names(self, source: str) -> list[str]:
        """The operation names of the SB that the state ``source`` does not have, most used
        first."""
        taken = self._branch.table.get(source, {})
        free = [name for name in self._uses if name not in taken]
        return sorted(free, key=lambda name: (-self._uses[name], name))

    def name_for(self, source: str, target: str | None) -> str:
        """The name of an operation that has the same effect elsewhere, else a fresh name."""
        if target in self._known and source in self._known:
            wanted = _effect(self._known[source], self._known[target or ""])
            for name in self.names(source):
                if wanted and self._majority.get(name) == wanted:
                    return name
        return fresh_operation_name(self._branch, source)

    def target_for(self, source: str, name: str) -> str:
        """The other state that an operation of this name would lead to; empty if unknown."""
        effect = self._majority.get(name)
        if not effect or source not in self._known:
            return ""
        wanted = list(self._known[source])
        for digit, value in effect:
            if digit < len(wanted):
                wanted[digit] = value
        if wanted == list(self._known[source]):
            # The facts have these values already, so the operation would lead back to its source.
            return ""
        return next((n for n, facts in self._known.items() if list(facts) == wanted), "")


def _effect(before: tuple[str, ...], after: tuple[str, ...]) -> Effect:
    if len(before) != len(after):
        return ()
    pairs = zip(before, after, strict=True)
    return tuple((digit, b) for digit, (a, b) in enumerate(pairs) if a != b)
