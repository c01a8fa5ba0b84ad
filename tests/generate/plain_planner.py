"""A plain planner: states are sets of atoms, and every formula is read again for every state.

It shares no line with the package. It is slow and short.
"""

from __future__ import annotations

import re
from collections import deque
from itertools import product
from typing import Any

Tree = Any
State = frozenset[tuple[str, ...]]


def tree(text: str) -> Tree:
    stack: list[Tree] = [[]]
    for word in re.findall(r"[()]|[^\s()]+", re.sub(r";[^\n]*", "", text).lower()):
        if word == "(":
            stack.append([])
        elif word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(word)
    return stack[0][0]


def typed(words: list[Tree]) -> list[tuple[str, list[str]]]:
    found: list[tuple[str, list[str]]] = []
    waiting: list[str] = []
    at = 0
    while at < len(words):
        if words[at] == "-":
            kind = words[at + 1]
            kinds = [kind] if isinstance(kind, str) else kind[1:]
            found += [(name, kinds) for name in waiting]
            waiting = []
            at += 2
        else:
            waiting.append(words[at])
            at += 1
    return found + [(name, ["object"]) for name in waiting]


class PlainPlanner:
    def __init__(self, domain: str, problem: str) -> None:
        self.sections: dict[str, Tree] = {}
        self.actions = []
        for part in (*tree(domain)[2:], *tree(problem)[2:]):
            if part[0] == ":action":
                self.actions.append((part[1], dict(zip(part[2::2], part[3::2], strict=True))))
            else:
                self.sections[part[0]] = part[1:]
        self.parents = dict(typed(self.sections.get(":types", [])))
        told = self.sections.get(":constants", []), self.sections.get(":objects", [])
        self.objects = [pair for words in told for pair in typed(words)]
        self.costs = {tuple(p[1]): float(p[2]) for p in self.sections[":init"] if p[0] == "="}
        self.init = frozenset(tuple(p) for p in self.sections[":init"] if p[0] not in ("=", "not"))

    def is_a(self, kinds: list[str], wanted: list[str]) -> bool:
        return bool(kinds) and any(
            kind in wanted or "object" in wanted
            or (kind in self.parents and kind != "object" and self.is_a(self.parents[kind], wanted))
            for kind in kinds
        )  # fmt: skip

    def ranges(self, words: list[Tree]) -> list[dict[str, str]]:
        names = typed(words)
        choices = [[o for o, kinds in self.objects if self.is_a(kinds, k)] for _, k in names]
        return [dict(zip((n for n, _ in names), one, strict=True)) for one in product(*choices)]

    def holds(self, f: Tree, s: State, g: dict[str, str]) -> bool:
        if not f:
            return True
        match f[0]:
            case "and":
                return all(self.holds(p, s, g) for p in f[1:])
            case "or":
                return any(self.holds(p, s, g) for p in f[1:])
            case "not":
                return not self.holds(f[1], s, g)
            case "imply":
                return not self.holds(f[1], s, g) or self.holds(f[2], s, g)
            case "forall":
                return all(self.holds(f[2], s, g | more) for more in self.ranges(f[1]))
            case "exists":
                return any(self.holds(f[2], s, g | more) for more in self.ranges(f[1]))
            case "=":
                return bool(g.get(f[1], f[1]) == g.get(f[2], f[2]))
        return tuple(g.get(w, w) for w in f) in s

    def change(self, e: Tree, s: State, g: dict[str, str], add: set[Any], cut: set[Any]) -> float:
        if not e:
            return 0
        match e[0]:
            case "and":
                return sum(self.change(p, s, g, add, cut) for p in e[1:])
            case "forall":
                return sum(self.change(e[2], s, g | m, add, cut) for m in self.ranges(e[1]))
            case "when":
                return self.change(e[2], s, g, add, cut) if self.holds(e[1], s, g) else 0
            case "not":
                cut.add(tuple(g.get(w, w) for w in e[1]))
                return 0
            case "increase":
                if isinstance(e[2], str):
                    return float(e[2])
                return self.costs[tuple(g.get(w, w) for w in e[2])]
        add.add(tuple(g.get(w, w) for w in e))
        return 0

    def search(self) -> tuple[list[State], list[dict[str, int]], list[int], dict[str, float]]:
        """The states in order, where each operation leads, the goal states, the costs."""
        states = {self.init: 0}
        rows: list[dict[str, int]] = []
        costs: dict[str, float] = {}
        queue = deque([self.init])
        while queue:
            state = queue.popleft()
            row = {}
            for name, parts in self.actions:
                for given in self.ranges(parts.get(":parameters", [])):
                    if self.holds(parts.get(":precondition", []), state, given):
                        add: set[Any] = set()
                        cut: set[Any] = set()
                        label = "_".join((name, *given.values()))
                        costs[label] = self.change(parts.get(":effect"), state, given, add, cut)
                        after = state - cut | add
                        if after not in states:
                            states[after] = len(states)
                            queue.append(after)
                        row[label] = states[after]
            rows.append(row)
        (goal,) = self.sections[":goal"]
        goals = [at for state, at in states.items() if self.holds(goal, state, {})]
        return list(states), rows, goals, costs
