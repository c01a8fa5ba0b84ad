"""All configurations that can be reached, by saturation.

Every node is brought to its fixpoint under the relations that reach no higher, from the lowest
level up. So most work is done on small sets, and layers of steps are never made.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.graph.joint.diagram import SHELVES, Diagram, Relation, clear, shelves
from smsl_studio.stop import heed

_Onward = dict[int, list[tuple[int, list[int]]]]
"""For each state of a level: the relations that reach no higher, and where they lead from it."""


class Saturation:
    """Finds what can be reached by some relations. Its diagram raises TooLarge."""

    def __init__(self, diagram: Diagram, relations: Sequence[Relation]) -> None:
        self._diagram, self._relations = diagram, relations
        self._onward: list[_Onward] = [{} for _ in range(diagram.height)]
        for number, relation in enumerate(relations):
            heed()
            by_state: dict[int, list[int]] = {}
            for state, target in relation.rows[relation.top] or ():
                by_state.setdefault(state, []).append(target)
            for state, targets in by_state.items():
                self._onward[relation.top].setdefault(state, []).append((number, targets))
        self._saturated: dict[int, int] = {}
        self._fired = shelves()

    def __del__(self) -> None:
        """Free the large tables in small steps."""
        clear(self._fired)

    def reached(self, start: Sequence[int]) -> int:
        """Return the set of the configurations that can be reached from one."""
        diagram = self._diagram
        states = [0] * diagram.height
        for one, state in enumerate(start):
            states[diagram.levels[one]] = state
        found = 1
        for level, state in enumerate(states):
            children = [0] * diagram.sizes[level]
            children[state] = found
            found = self._saturate(diagram.node(level, tuple(children)), level)
        return found

    def closed(self, node: int) -> int:
        """Return the set of the configurations that can be reached from a set of them."""
        return self._closed(node, self._diagram.height - 1, {})

    def _closed(self, node: int, level: int, seen: dict[int, int]) -> int:
        if node < 2:
            return node
        found = seen.get(node)
        if found is None:
            diagram = self._diagram
            diagram.spend()
            below = tuple(self._closed(one, level - 1, seen) for one in diagram.children[node])
            found = seen[node] = self._saturate(diagram.node(level, below), level)
        return found

    def _saturate(self, node: int, level: int) -> int:
        if node < 2:
            return node
        found = self._saturated.get(node)
        if found is not None:
            return found
        diagram = self._diagram
        diagram.spend()
        children = list(diagram.children[node])
        onward = self._onward[level]
        waiting = [state for state, one in enumerate(children) if one and state in onward]
        while waiting:
            state = waiting.pop()
            for number, targets in onward[state]:
                one = children[state]
                if self._relations[number].bottom < level:
                    one = self._fire(one, number, level - 1)
                for target in targets if one else ():
                    before = children[target]
                    if one != before:
                        after = diagram.union(before, one, level - 1)
                        if after != before:
                            children[target] = after
                            if target in onward:
                                waiting.append(target)
        found = diagram.node(level, tuple(children))
        self._saturated[node] = self._saturated[found] = found
        return found

    def _fire(self, node: int, number: int, level: int) -> int:
        key = node, number
        known = self._fired[node % SHELVES]
        found = known.get(key)
        if found is not None:
            return found
        diagram, relation = self._diagram, self._relations[number]
        diagram.spend()
        rows, last, below = relation.rows[level], relation.bottom >= level, level - 1
        children = diagram.children[node]
        if rows is None:
            further = [self._fire(one, number, below) if one else 0 for one in children]
        else:
            further = [0] * len(children)
            for state, target in rows:
                one = children[state]
                if one:
                    one = one if last else self._fire(one, number, below)
                    further[target] = diagram.union(further[target], one, below)
        found = self._saturate(diagram.node(level, tuple(further)), level)
        known[key] = found
        return found
