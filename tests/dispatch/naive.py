"""Clauses 5, 10, 11 and 12 of the meaning of a run, written a second time as simply as possible.

This is an oracle for the planner and the dispatcher. It shares no code with them, keeps no plan,
prunes nothing and walks every joint configuration.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Mapping
from typing import Any

Plain = dict[str, Any]
Config = dict[str, str]


class Naive:
    """A blueprint as plain JSON values, states named ``S`` and the digits, values 0 and 1."""

    def __init__(self, plain: Plain, avoid: frozenset[str] = frozenset()) -> None:
        self.plain, self.avoid = plain, avoid

    def head(self, sb: str) -> Plain:
        return dict(self.plain[sb]["HEADER"])

    def subs(self, sb: str) -> dict[str, int]:
        return dict(self.head(sb).get("SUB_SBS", {}))

    def bases(self, sub: str) -> list[tuple[str, int]]:
        return [(sb, self.subs(sb)[sub]) for sb in self.plain if sub in self.subs(sb)]

    def digit(self, state: str, digit: int) -> str:
        return state[1:][digit]

    def note(self, sb: str, op: str) -> Plain:
        return dict(self.plain[sb].get("_operations", {}).get(op, {}))

    def cost(self, sb: str, op: str) -> float:
        return float(self.note(sb, op).get("cost", 1))

    def edges(self, sb: str, state: str) -> list[tuple[str, str]]:
        return list(self.plain[sb][state].items())

    def changes(self, sb: str, a: str, b: str) -> tuple[list[str], list[str], bool]:
        """The subs that fall, the subs that rise, and whether another digit changes."""
        by_digit = {digit: sub for sub, digit in self.subs(sb).items()}
        falls, rises, other = [], [], False
        for digit, (x, y) in enumerate(zip(a[1:], b[1:], strict=True)):
            if x == y:
                continue
            if digit not in by_digit:
                other = True
            elif y == "1":
                rises.append(by_digit[digit])
            else:
                falls.append(by_digit[digit])
        return falls, rises, other

    def fails(self, sb: str, state: str) -> bool:
        """Whether a state holds a value that is declared a failure."""
        notes = self.plain[sb].get("_facts", {})
        return any(
            self.digit(state, int(digit)) in note["failure"] for digit, note in notes.items()
        )

    def healthy(self, config: Config, root: str) -> bool:
        return not any(self.fails(sb, config[sb]) for sb in self.tree(root))

    def usable(self, config: Config, sb: str, op: str) -> bool:
        if f"{sb}/{config[sb]}/{op}" in self.avoid:
            return False
        if self.fails(sb, self.plain[sb][config[sb]][op]) and not self.fails(sb, config[sb]):
            return False
        for key, value in self.note(sb, op).get("requires", {}).items():
            name, digit = key.split("/")
            if self.digit(config[name], int(digit)) != value:
                return False
        return True

    def below(self, sb: str, state: str) -> Config:
        """Where a load leaves an SB and all below it."""
        found = {sb: state}
        for sub, digit in self.subs(sb).items():
            head = self.head(sub)
            on = self.digit(state, digit) == "1"
            found.update(self.below(sub, head["ACTIVATING"] if on else head["INITIAL"]))
        return found

    def along(
        self, config: Config, sub: str, up: bool, busy: Mapping[str, tuple[str, str]]
    ) -> dict[str, tuple[str, str]] | None:
        """The bases' edges that a crossing takes along, busy ones included; None: not permitted."""
        busy = dict(busy)
        for base, _ in self.bases(sub):
            if base in busy:
                falls, rises, _ = self.changes(base, config[base], busy[base][1])
                if sub not in (rises if up else falls):
                    return None
                continue
            found = None
            options = sorted(
                self.edges(base, config[base]), key=lambda e: (self.cost(base, e[0]), e[0])
            )
            for op, target in options:
                falls, rises, other = self.changes(base, config[base], target)
                single = (falls, rises) == ([], [sub]) if up else (falls, rises) == ([sub], [])
                load = self.note(base, op).get("subs") == "load"
                if not single or other or load or not self.usable(config, base, op):
                    continue
                attempt = {**busy, base: (op, target)}
                active = self.head(base)["ACTIVATING"]
                if self.bases(base) and (target == active) != (config[base] == active):
                    more = self.along(config, base, target == active, attempt)
                    if more is None:
                        continue
                    attempt = more
                found = attempt
                break
            if found is None:
                return None
            busy = found
        return busy

    def carry(
        self, config: Config, sb: str, op: str, busy: Mapping[str, tuple[str, str]]
    ) -> tuple[Config, float] | None:
        """Carry an edge out by clause 5; ``busy`` are the base edges that are under way."""
        target = self.plain[sb][config[sb]][op]
        if not self.usable(config, sb, op):
            return None
        falls, rises, other = self.changes(sb, config[sb], target)
        active = self.head(sb)["ACTIVATING"]
        own = {**busy, sb: (op, target)}
        taken: dict[str, tuple[str, str]] = dict(own)
        if self.bases(sb) and (target == active) != (config[sb] == active):
            more = self.along(config, sb, target == active, own)
            if more is None:
                return None
            taken = more
        here, cost = dict(config), 0.0
        if self.note(sb, op).get("subs") == "load" and (falls or rises):
            places: Config = {}
            for sub in [*falls, *rises]:
                head = self.head(sub)
                places.update(self.below(sub, head["ACTIVATING" if sub in rises else "INITIAL"]))
            for sub, state in places.items():
                if self.fails(sub, state) and not self.fails(sub, config[sub]):
                    return None
                active = self.head(sub)["ACTIVATING"]
                if (state == active) != (config[sub] == active):
                    loaded = {base: (op, end) for base, end in places.items()}
                    more = self.along(config, sub, state == active, {**loaded, **taken})
                    if more is None:
                        return None
                    taken = {base: e for base, e in more.items() if base not in places}
            cost = self.cost(sb, op)
            here.update(places)
        else:
            for sub in [*falls, *rises]:
                head = self.head(sub)
                goal = head["ACTIVATING" if sub in rises else "INITIAL"]
                part = self.sub_route(here, sub, goal, taken)
                if part is None:
                    return None
                here, cost = part[0], cost + part[1]
            single = len(falls) + len(rises) == 1 and not other
            if not single:
                cost += self.cost(sb, op)
        here[sb] = target
        for base, (_, end) in taken.items():
            if base not in own:
                here[base] = end
        if not busy and not self.agrees(here):
            return None
        return here, cost

    def sub_route(
        self, config: Config, sub: str, goal: str, busy: Mapping[str, tuple[str, str]]
    ) -> tuple[Config, float] | None:
        """The cheapest of the sub's own edges to a goal that cross once at most, or None.

        Ties go by number, then by names, as everywhere.
        """
        active = self.head(sub)["ACTIVATING"]
        heap: list[Any] = [(0.0, 0, (), sorted(config.items()))]
        seen = set()
        while heap:
            cost, count, names, items = heapq.heappop(heap)
            here = dict(items)
            if here[sub] == goal:
                return here, cost
            if str(items) in seen:
                continue
            seen.add(str(items))
            for op, target in self.edges(sub, here[sub]):
                enters, leaves = (
                    target == active != here[sub],
                    here[sub] == active != target,
                )
                if (enters and goal != active) or (leaves and goal == active):
                    continue
                part = self.carry(here, sub, op, busy)
                if part is not None:
                    total = round(cost + part[1], 9)
                    heapq.heappush(heap, (total, count + 1, (*names, op), sorted(part[0].items())))
        return None

    def agrees(self, config: Config) -> bool:
        """Digit on if and only if the sub is in its ACTIVATING state."""
        return all(
            (self.digit(config[sb], digit) == "1") == (config[sub] == self.head(sub)["ACTIVATING"])
            for sb in self.plain
            for sub, digit in self.subs(sb).items()
        )

    def tree(self, root: str) -> list[str]:
        return [root] + [name for sub in self.subs(root) for name in self.tree(sub)]

    def moves(self, config: Config, root: str) -> Iterator[tuple[Config, float]]:
        for sb in dict.fromkeys(self.tree(root)):
            for op, _ in self.edges(sb, config[sb]):
                part = self.carry(config, sb, op, {})
                if part is not None:
                    yield part

    def best(self, start: Config, root: str, goals: Config | None) -> float | None:
        """The lowest cost of a sequence of permitted operations to the goals, or None; without
        goals, to where nothing has failed."""
        heap: list[Any] = [(0.0, sorted(start.items()))]
        done = set()
        while heap:
            cost, items = heapq.heappop(heap)
            here = dict(items)
            there = goals is None and self.healthy(here, root)
            if there or (goals and all(here[sb] == state for sb, state in goals.items())):
                return float(cost)
            if str(items) in done:
                continue
            done.add(str(items))
            for after, more in self.moves(here, root):
                heapq.heappush(heap, (round(cost + more, 9), sorted(after.items())))
        return None
