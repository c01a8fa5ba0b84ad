"""Random commands, disturbances and faults of a run, and when they happen."""

from __future__ import annotations

from random import Random
from typing import Any

from tests.oracle.random_blueprint import RandomBlueprint

Json = Any

PLAIN = ("pause", "pause", "resume", "resume", "step", "stop", "reset", "end", "take_over",
         "give_back", "accept", "adopt", "by_hand", "automatic")  # fmt: skip
"""The commands that the oracle knows. A new one comes here together with the oracle's own rules."""


class RandomScript:
    """Acts for a run of one blueprint."""

    def __init__(self, random: Random, drawn: RandomBlueprint) -> None:
        self.random, self.drawn = random, drawn

    def acts(self, *, walks: bool) -> list[Json]:
        """Some acts, each with its moment; ``walks``: operations are asked for one by one, too."""
        random = self.random
        acts = [
            {**self._moment(), **self._act(), "by": random.choice(["Ada", "script"])}
            for _ in range(random.choice([0, 1, 1, 2, 3, 4, 6]))
        ]
        return [*acts, *self._walk()] if walks else acts

    def _walk(self) -> list[Json]:
        """Operations out of the states that are active then, asked for one after the other."""
        tick, acts = 0, []
        for _ in range(self.random.randint(3, 12)):
            tick += self.random.choice([1, 2, 4, 8])
            acts.append({"tick": tick, "do": "ask", "choose": self.random.randrange(1000)})
        return acts

    def _moment(self) -> Json:
        """A tick, or so many ticks after something was told; often around that of the goal."""
        random = self.random
        plus = random.choice([0, 0, 1, 1, 2, 3, 5])
        return random.choice(
            [
                {"tick": random.randrange(25)},
                {"on": "goal", "plus": random.choice([0, 1, 1, 2, 3])},
                {"on": "goal", "plus": random.choice([0, 1, 1, 2, 3])},
                {"on": "committed", "nth": random.randint(1, 4), "plus": plus},
                {"on": "operation_started", "nth": random.randint(1, 5), "plus": plus},
                {"on": "operation_started", "nth": random.randint(1, 3), "plus": plus},
                {"on": "held", "plus": plus},
                {"on": "paused", "plus": plus},
                {"on": "task_opened", "plus": plus},
                {"on": "mismatch", "plus": plus},
                {"on": "stopped", "plus": plus},
                {"on": "taken_over", "plus": plus},
            ]
        )

    def _act(self) -> Json:
        kind = self.random.random()
        if kind < 0.3:
            return self._disturbance()
        if kind < 0.5:
            return self._fault()
        if kind < 0.75:
            return {"do": self.random.choice(PLAIN)}
        return self._about_an_edge()

    def _fact(self) -> tuple[str, str]:
        """A fact and a value of it."""
        some = self.drawn.watched if self.random.random() < 0.5 else ()
        fact = self.random.choice(some or self.drawn.leaves)
        name, digit = fact.split("/")
        return fact, self.random.choice(self.drawn.alphabets[name][int(digit)])

    def _disturbance(self) -> Json:
        fact, value = self._fact()
        kinds: list[Json] = [
            {"kind": "dropout"},
            {"kind": "dropout"},
            {"kind": "dropout", "with": {"rate": 0.6}},
            {"kind": "stuck"},
            {"kind": "stuck", "with": {"value": value}},
            {"kind": "noise", "with": {"rate": 0.5}},
            {"kind": "delay", "with": {"seconds": 0.1}},
            {"kind": "delay", "with": {"seconds": 0.5}},
            {"kind": "drift", "with": {"every": 0.3}},
            {"kind": "none"},
        ]
        return {"do": "disturb", "target": fact, **self.random.choice(kinds)}

    def _fault(self) -> Json:
        fact, value = self._fact()
        states = [f"{name}/{state}" for name in self.drawn.subs for state in self.drawn.names[name]]
        faults: list[Json] = [
            {"fault": "set", "with": {"fact": fact, "value": value}},
            {"fault": "set", "with": {"fact": fact, "value": value}},
            {"fault": "fail"},
            {"fault": "raise"},
            {"fault": "hang"},
            {"fault": "nothing"},
            {"fault": "elsewhere", "with": {"state": self.random.choice(states)}},
        ]
        return {"do": "inject", **self.random.choice(faults)}

    def _about_an_edge(self) -> Json:
        edge = self.random.choice(self.drawn.edges)
        return self.random.choice(
            [
                {"do": "ask", "address": edge},
                {"do": "ask", "address": edge},
                {"do": "veto"},
                {"do": "veto", "address": edge},
                {"do": "prune", "address": edge},
                {"do": "restore", "address": edge},
                {"do": "set_cost", "address": edge, "cost": self.random.choice([0.0, 1.5, 7.0])},
            ]
        )
