"""Random questions about small blueprints, and their answers by brute force.

The steps are those of ``tests/dispatch/naive.py``, which shares no code with the program. Each
answer is looked up in the list of all configurations that can be reached.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import RunRefused
from tests.dispatch.naive import Config, Naive

Hit = Callable[[Config], bool]


def starts_of(question: Callable[[], object], *blueprints: Blueprint) -> list[Config]:
    """Where runs of blueprints start. Without a start of each there are none, and the question is
    refused for the same reason."""
    try:
        return [start_configuration(Hierarchy(one), {}) for one in blueprints]
    except RunRefused:
        with pytest.raises(RunRefused):
            question()
        return []


class Brute:
    """All configurations that can be reached in committed steps, with their distances."""

    def __init__(self, plain: dict[str, Any], start: Config) -> None:
        self.naive, self.start = Naive(plain), start
        self.far: dict[tuple[str, ...], int] = {self.key(start): 0}
        self.configs = [start]
        for here in self.configs:
            for after in self.steps(here):
                if self.key(after) not in self.far:
                    self.far[self.key(after)] = self.far[self.key(here)] + 1
                    self.configs.append(after)

    def key(self, config: Config) -> tuple[str, ...]:
        return tuple(config[name] for name in sorted(config))

    def steps(self, config: Config) -> Iterator[Config]:
        for sb in self.naive.plain:
            for op, _ in self.naive.edges(sb, config[sb]):
                found = self.naive.carry(config, sb, op, {})
                if found is not None:
                    yield found[0]

    def goal(self, config: Config) -> bool:
        roots = [sb for sb in self.naive.plain if not self.naive.bases(sb)]
        return all(config[sb] == self.naive.head(sb)["ACTIVATING"] for sb in roots)

    def reached(self, hit: Hit) -> int | None:
        """The distance of the nearest configuration that is hit."""
        return min((self.far[self.key(one)] for one in self.configs if hit(one)), default=None)

    def way(self, sources: list[Config], may: Hit, hit: Hit) -> int | None:
        """The number of steps from one of ``sources`` to a hit, through what may be visited."""
        far = {self.key(one): 0 for one in sources if may(one)}
        waiting = [one for one in sources if may(one)]
        for here in waiting:
            if hit(here):
                return far[self.key(here)]
            for after in self.steps(here):
                if may(after) and self.key(after) not in far:
                    far[self.key(after)] = far[self.key(here)] + 1
                    waiting.append(after)
        return None

    def before(self, first: Hit, second: Hit) -> int | None:
        """The length of the shortest way on which ``first`` never holds and then ``second``."""
        return self.way([self.start], lambda one: not first(one), second)

    def after(self, first: Hit, second: Hit) -> int | None:
        """The length of the shortest way to a goal that has passed ``first`` and then no
        ``second``."""
        found = []
        for one in self.configs:
            if first(one) and not second(one):
                rest = self.way([one], lambda other: not second(other), self.goal)
                if rest is not None:
                    found.append(self.far[self.key(one)] + rest)
        return min(found, default=None)

    def no_way_back(self, first: Hit, second: Hit, within: int | None) -> int | None:
        """The distance of the nearest configuration with ``first`` that has no way back."""
        found = []
        for one in self.configs:
            if first(one):
                steps = self.way([one], lambda other: True, second)
                if steps is None or (within is not None and steps > within):
                    found.append(self.far[self.key(one)])
        return min(found, default=None)


def drawn_condition(plain: dict[str, Any], chance: Random) -> tuple[str, Hit]:
    """A random condition: its text, and a function that tells whether it holds."""
    kind = chance.randrange(5)
    if kind < 2:
        sb = chance.choice(list(plain))
        digit = chance.randrange(plain[sb]["HEADER"]["NUM_FACTS"])
        states = [name for name in plain[sb] if name.startswith("S")]
        value = chance.choice(states)[1 + digit]
        equal = chance.random() < 0.7
        text = f"{sb}/{digit} {'=' if equal else '!='} {value}"
        return text, lambda one: (one[sb][1 + digit] == value) == equal
    if kind == 2:
        sb = chance.choice(list(plain))
        state = chance.choice([name for name in plain[sb] if name.startswith("S")])
        return f"{sb} in {state}", lambda one: one[sb] == state
    (left, one_holds), (right, other_holds) = (drawn_condition(plain, chance) for _ in range(2))
    if kind == 3:
        return f"({left}) and ({right})", lambda one: one_holds(one) and other_holds(one)
    return f"not ({left}) or ({right})", lambda one: not one_holds(one) or other_holds(one)
