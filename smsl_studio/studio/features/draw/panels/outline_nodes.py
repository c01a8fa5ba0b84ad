"""The tree of the outline: SBs by level, their facts, and each sub-SB below its fact.

The children of a node are made when they are asked for. SBs that share sub-SBs can have far too
many paths to make them all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.studio.features.draw.panels.outline_lines import (
    OutlineLine,
    branch_line,
    fact_line,
    fault_line,
)

DEEPEST = 40
"""At most this many levels are nested. Deeper SBs begin at the top level again."""

MOST_PLANNED = 200
"""At most this many facts are listed of an SB without states: NUM_FACTS can be any number."""

Key = tuple[str, int | None]
"""(SB, None) for an SB, (SB, digit) for a fact, ("", number) for an import that failed."""


@dataclass(slots=True, eq=False)
class OutlineNode:
    """A node of the tree. ``below`` holds its children; None until somebody asks for them.

    ``depth`` counts the SBs above it.
    """

    number: int
    key: Key
    above: OutlineNode | None
    row: int
    depth: int
    below: list[OutlineNode] | None = None

    @property
    def path(self) -> tuple[int, ...]:
        """The row numbers from the top to this node; a smaller path is further up."""
        rows: list[int] = []
        node: OutlineNode | None = self
        while node is not None and node.above is not None:
            rows.append(node.row)
            node = node.above
        return tuple(reversed(rows))


@dataclass
class Survey:
    """The SBs at the top level (``margin``) with their level, and the base (SB, digit) of each
    other SB.

    At the top level are the roots, the SBs that only a cycle or an unknown base refers to (so that
    none is hidden), and the SBs that are nested too deeply.
    """

    margin: dict[str, int] = field(default_factory=dict)
    bases: dict[str, tuple[str, int]] = field(default_factory=dict)


def surveyed(blueprint: Blueprint) -> Survey:
    """The shortest path to every SB. It does not look at facts."""
    found = Survey(dict.fromkeys(blueprint.roots, 0))
    deep: dict[str, int] = {}
    branches, depth = blueprint.branches, 0
    reached = set(blueprint.roots)
    names = list(blueprint.roots)
    while names:
        below: list[str] = []
        for name in names:
            branch = branches[name]
            if not branch.header.sub_sbs:
                continue
            for digit, sub in branch.subs.items():
                if sub not in reached and sub in branches:
                    reached.add(sub)
                    found.bases[sub] = name, digit
                    below.append(sub)
        names, depth = below, depth + 1
        if depth % DEEPEST == 0:
            deep.update(dict.fromkeys(names, depth))
    found.margin.update((name, 0) for name in branches if name not in reached)
    found.margin.update(deep)
    return found


def has_facts(branch: StateBranch) -> bool:
    """Whether an SB has lines for facts."""
    return told_facts(branch) > 0 if branch.table else bool(_planned_digits(branch))


def _planned_digits(branch: StateBranch) -> list[int]:
    """The facts that the header of an SB without states plans: the first of NUM_FACTS, and those
    that a sub-SB expands, so that no sub-SB is hidden."""
    first = range(min(branch.header.num_facts or 0, MOST_PLANNED))
    return sorted({*first, *(digit for digit in branch.subs if digit >= 0)})


class OutlineNodes:
    """The nodes of one blueprint, made when they are asked for."""

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self.survey = surveyed(blueprint)
        self.root = OutlineNode(0, ("", None), None, 0, -1)
        self.asked: dict[int, OutlineNode] = {}
        """The nodes whose children were made, by number, parents first."""
        self._made: dict[int, OutlineNode] = {}
        self._standing: dict[Key, dict[int, OutlineNode]] = {}
        self._last = 0

    @property
    def top(self) -> list[OutlineNode]:
        """The nodes at the top level."""
        return self.below(self.root)

    @property
    def made(self) -> int:
        """How many nodes were made."""
        return len(self._made)

    def replace(self, blueprint: Blueprint) -> None:
        """Take another blueprint. The caller compares ``keys`` and corrects the nodes."""
        self.blueprint, self.survey = blueprint, surveyed(blueprint)

    def node(self, number: int) -> OutlineNode | None:
        """The node with this number; None if it was dropped."""
        return self._made.get(number)

    def below(self, node: OutlineNode) -> list[OutlineNode]:
        """The children of a node, made if they are missing."""
        if node.below is None:
            node.below = self.make(node, self.keys(node), 0)
            self.asked[node.number] = node
        return node.below

    def leads_down(self, node: OutlineNode) -> bool:
        """Whether a node has children, found without counting facts."""
        if node.below is not None:
            return bool(node.below)
        name, digit = node.key
        if not name or digit is not None:
            return bool(self.keys(node))
        branch = self.blueprint.branches.get(name)
        if branch is None or node.depth >= DEEPEST:
            return False
        return has_facts(branch)

    def keys(self, node: OutlineNode) -> list[Key]:
        """The keys of the children that a node should have now."""
        name, digit = node.key
        if node.above is None:
            faults = range(len(self.blueprint.import_faults))
            return [*((one, None) for one in self.survey.margin), *(("", n) for n in faults)]
        branch = self.blueprint.branches.get(name)
        if branch is None:
            return []
        if digit is None:
            if node.depth >= DEEPEST:
                return []
            digits = range(told_facts(branch)) if branch.table else _planned_digits(branch)
            return [(name, at) for at in digits]
        sub = branch.subs.get(digit, "")
        if sub not in self.blueprint.branches or _stands_above(node, sub):
            return []
        return [(sub, None)]

    def line(self, node: OutlineNode, worst: Mapping[str, str]) -> OutlineLine:
        """The content of a node.

        ``worst`` holds the worst severity letter by SB (see ``worst_of``).
        """
        name, digit = node.key
        if not name and digit is not None:
            return fault_line(self.blueprint.import_faults[digit])
        if digit is not None:
            return fact_line(self.blueprint, name, digit)
        top = node
        while top.above is not None and top.above.above is not None:
            top = top.above
        level = self.survey.margin.get(top.key[0], 0) + node.depth
        return branch_line(self.blueprint, name, level, worst.get(name, ""))

    def make(self, above: OutlineNode, keys: Iterable[Key], row: int) -> list[OutlineNode]:
        """Make child nodes with these keys, from the row ``row`` on."""
        # A fact has the depth of its SB; its sub-SB is one deeper.
        depth = above.depth + (above.key[1] is not None or above.above is None)
        made = []
        for at, key in enumerate(keys, row):
            self._last += 1
            node = OutlineNode(self._last, key, above, at, depth)
            self._made[node.number] = node
            self._standing.setdefault(key, {})[node.number] = node
            made.append(node)
        return made

    def drop(self, nodes: Iterable[OutlineNode]) -> None:
        """Forget nodes and everything below them."""
        stack = list(nodes)
        while stack:
            node = stack.pop()
            del self._made[node.number]
            self.asked.pop(node.number, None)
            self._leave(node)
            stack += node.below or ()

    def rename(self, node: OutlineNode, key: Key) -> None:
        """Give a node another key, because its SB was renamed."""
        self._leave(node)
        node.key = key
        self._standing.setdefault(key, {})[node.number] = node

    def standing(self, key: Key) -> list[OutlineNode]:
        """All nodes of an SB or a fact that were made."""
        return list(self._standing.get(key, {}).values())

    def first(self, key: Key) -> OutlineNode | None:
        """The uppermost node of an SB or a fact.

        If none was made, one is made on the shortest path.
        """
        found = self.standing(key)
        if found:
            return min(found, key=lambda node: node.path) if len(found) > 1 else found[0]
        name, digit = key
        way: list[tuple[str, int]] = [] if digit is None else [(name, digit)]
        while name not in self.survey.margin:
            if name not in self.survey.bases:
                return None
            way.append(self.survey.bases[name])
            name = way[-1][0]
        above = (one for one in self.top if one.key == (name, None))
        at = next(above, None)
        for _, down in reversed(way):
            facts = self.below(at) if at is not None else []
            at = facts[down] if 0 <= down < len(facts) else None
            if at is not None and at.key != key:
                at = next(iter(self.below(at)), None)
        return at

    def _leave(self, node: OutlineNode) -> None:
        others = self._standing[node.key]
        del others[node.number]
        if not others:
            del self._standing[node.key]


def _stands_above(node: OutlineNode, branch: str) -> bool:
    above: OutlineNode | None = node
    while above is not None:
        if above.key[0] == branch:
            return True
        above = above.above
    return False
