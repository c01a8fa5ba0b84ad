"""Random cases from a number: a blueprint, what is asked, a world, and what happens meanwhile.

Equal numbers give equal cases. A case is plain JSON, see ``recorded_run``.
"""

from __future__ import annotations

from random import Random
from typing import Any

from tests.oracle.drawing import Drawing
from tests.oracle.random_blueprint import SHAPES, RandomBlueprint
from tests.oracle.random_script import RandomScript

Json = Any


def case_of(number: int) -> dict[str, Json]:
    """The case of this number."""
    return _Case(Random(number)).made(number)


class _Case:
    """``quiet``: nothing is said, disturbed or broken, so that its end is certain."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.subs = random.choice(SHAPES)
        self.quiet = random.random() < 0.2
        self.peopled = not self.quiet and random.random() < 0.3
        self.drawn = RandomBlueprint(random, quiet=self.quiet, peopled=self.peopled, subs=self.subs)
        self.walks = False

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def made(self, number: int) -> dict[str, Json]:
        values = self.drawn.values
        asked = self._asked()
        made: dict[str, Json] = {
            "number": number,
            "seed": number % 7,
            "blueprint": values,
            "asked": asked,
            "world": self._world(),
            "goal_states": asked.get("goals")
            or [f"{name}/{values[name]['HEADER']['ACTIVATING']}" for name in self.drawn.roots],
        }
        if self.peopled:
            words = ["yes"] * 6 + ["no", "silent"]
            self.random.shuffle(words)
            made["people"] = {"plus": self.random.choice([0, 1, 3]), "words": words}
        if not self.quiet:
            made["script"] = RandomScript(self.random, self.drawn).acts(walks=self.walks)
            if self.chance(0.1):
                words = ["allow", "veto", "prune", "pause", "ask"]
                made["agent"] = self.random.choices(words, [6, 1, 1, 1, 1], k=6)
            self._press(made, Random(f"{number} pressed"))
        return made

    def _press(self, made: dict[str, Json], random: Random) -> None:
        """In some cases what an operation requires is lost while it lasts, or just before."""
        drawing = Drawing(self.drawn.values, {})
        needy = {
            edge: sorted(set(drawing.note(edge).get("requires", ())) & set(self.drawn.leaves))
            for edge in self.drawn.edges
        }
        needy = {edge: facts for edge, facts in needy.items() if facts}
        if not needy or random.random() > 0.4:
            return
        lasts = made["world"].setdefault("lasts", {})
        for edge, facts in needy.items():
            lasts[edge] = random.choice([2, 4, 7])
            fact = random.choice(facts)
            name, digit = fact.split("/")
            value = random.choice(self.drawn.alphabets[name][int(digit)])
            act = random.choice(
                [
                    {"do": "disturb", "target": fact, "kind": "dropout"},
                    {"do": "inject", "fault": "set", "with": {"fact": fact, "value": value}},
                ]
            )
            moment = {"on": "operation_started", "of": edge, "plus": random.randrange(3)}
            before = {"tick": random.randrange(8)}
            made["script"].append({**random.choice([moment, moment, before]), **act})
            note = self.drawn.values[name]["_facts"].setdefault(digit, {})
            note["max_age"] = random.choice([0.06, 0.12])

    def _asked(self) -> Json:
        random, drawn = self.random, self.drawn
        asked: dict[str, Json] = {"attended": not self.quiet and self.chance(0.6)}
        if self.chance(0.3):
            asked["start"] = self._start()
        if self.chance(0.4):
            asked["goals"] = self._goals(asked.get("start", {}))
        if self.chance(0.15):
            asked["avoid"] = random.sample(drawn.edges, min(2, len(drawn.edges)))
        if self.chance(0.35):
            asked["on_mismatch"] = "adopt"
        self.walks = asked["attended"] and self.chance(0.3)
        if asked["attended"] and self.chance(0.8 if self.walks else 0.05):
            asked["automatic"] = False
        if self.peopled:
            levels: dict[str, str] = {}
            if self.chance(0.15):
                levels["supervision"] = "human"
            if self.chance(0.15):
                levels[random.choice(drawn.leaves)] = "shared"
            asked["levels"] = levels
        return asked

    def _start(self) -> dict[str, str]:
        """Somewhere else than INITIAL; now and then where bases and subs do not agree."""
        if self.drawn.places and self.chance(0.85):
            return dict(self.random.choice(self.drawn.places))
        names = self.random.sample(list(self.subs), self.random.randint(1, len(self.subs)))
        return {name: self.random.choice(self.drawn.names[name]) for name in names}

    def _goals(self, start: dict[str, str]) -> list[str]:
        """One or two states, far away or near; now and then such that contradict."""
        random, drawn = self.random, self.drawn
        names = random.sample(list(self.subs), min(len(self.subs), random.choice([1, 1, 2])))
        if not drawn.places or not self.chance(0.9):
            return [f"{name}/{random.choice(drawn.names[name])}" for name in names]
        first = {name: drawn.values[name]["HEADER"]["INITIAL"] for name in self.subs} | start
        some = random.choices(drawn.places, k=random.choice([1, 20]))
        there = max(some, key=lambda one: drawn.distance(first, one))
        return [f"{name}/{there[name]}" for name in names]

    def _world(self) -> Json:
        random, edges = self.random, self.drawn.edges
        world: dict[str, Json] = {}
        if self.chance(0.2):
            world["settle"] = random.choice([0.05, 0.15])
        if self.chance(0.15):
            world["unbound"] = random.sample(edges, min(2, len(edges)))
        if self.chance(0.15):
            world["exact"] = random.sample(edges, min(4, len(edges)))
        if self.chance(0.4):
            few = random.sample(edges, min(random.choice([6, 20]), len(edges)))
            world["lasts"] = {edge: random.choice([1, 2, 4, 8]) for edge in few}
        if self.chance(0.12):
            world["blind"] = random.sample(self.drawn.leaves, 1)
        if not self.quiet and self.chance(0.2):
            self._second_sensor(world)
        return world

    def _second_sensor(self, world: dict[str, Json]) -> None:
        """One fact has two sensors, and the second says otherwise or nothing for a while."""
        random = self.random
        fact = random.choice(self.drawn.leaves)
        if fact in world.get("blind", ()):
            return
        name, digit = fact.split("/")
        note = self.drawn.values[name]["_facts"].setdefault(digit, {})
        if note.get("aggregation") == "human":
            return
        note["aggregation"] = random.choice(["single", "all", "any", "k_of_n", "priority"])
        if self.chance(0.4):
            note["conflict_after"] = 0.2
        first = random.randrange(20)
        last = first + random.choice([1, 4, 30])
        word = random.choice(["silent", "wrong", "nothing"])
        value = random.choice(self.drawn.alphabets[name][int(digit)])
        world["eyes"] = {fact: [[first, last, word, None if word == "nothing" else value]]}
