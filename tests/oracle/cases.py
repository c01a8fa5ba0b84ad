"""Random cases from a number: a blueprint, what is asked, a world, and what happens meanwhile.

Equal numbers give equal cases. A case is plain JSON, see ``recorded_run``.
"""

from __future__ import annotations

from random import Random
from typing import Any

from tests.oracle.carriage import carry
from tests.oracle.drawing import Drawing
from tests.oracle.hazards import places
from tests.oracle.random_blueprint import SHAPES, RandomBlueprint
from tests.oracle.random_script import RandomScript
from tests.oracle.standing import start_of
from tests.oracle.terms import Terms

Json = Any


GUARDED = (11, 22, 28, 29, 33, 35, 36, 37, 39)
"""Of 40 cases these have hazards; the others are as they were before there were any."""
LOST = 29
"""The one of them in which a fact is lost in the middle of a step."""


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
        if number % 40 in GUARDED:
            self._endanger(made, Random(f"{number} endangered"))
        if number % 40 == LOST and "script" in made:
            self._lost_on_the_way(made, Random(f"{number} lost"))
        return made

    def _endanger(self, made: dict[str, Json], random: Random) -> None:
        """One or two hazards, seldom met at the start; in half of the cases something happens to
        their facts."""
        drawn = self.drawn
        start = {name: drawn.values[name]["HEADER"]["INITIAL"] for name in self.subs}
        start |= made["asked"].get("start", {})
        drawing = Drawing(drawn.values, {})
        every = [f"{name}/{d}" for name in self.subs for d in range(len(drawn.alphabets[name]))]
        hazards: list[Json] = []
        for number in range(random.choice([1, 1, 2])):
            for _ in range(6):
                some = random.sample(every, min(random.choice([1, 2, 2, 2, 3]), len(every)))
                facts = {fact: random.choice(drawing.alphabet(fact)) for fact in some}
                met = all(_value(drawing, start, fact) == facts[fact] for fact in some)
                if not met or random.random() < 0.03:
                    break
            hazards.append({"name": f"H{number}", "facts": facts})
        made["blueprint"] = {"_hazards": hazards, **drawn.values}
        if "script" in made:
            for _ in range(random.choice([0, 0, 1, 2])):
                made["script"] += self._happens(random, random.choice(hazards)["facts"])
            some = random.sample(drawn.edges, min(5, len(drawn.edges)))
            made["world"].setdefault("lasts", {}).update(dict.fromkeys(some, 3))

    def _lost_on_the_way(self, made: dict[str, Json], random: Random) -> None:
        """A step of several functions is asked for from the start, and a fact of another SB, which
        a hazard names, is lost during the first one."""
        drawn, drawing = self.drawn, Drawing(self.drawn.values, {})
        start = start_of(drawing, made["asked"].get("start", {}))
        if isinstance(start, str):
            return
        every = [
            step
            for edge in drawn.edges
            if (step := carry(Terms(drawing), edge, start)) is not None and len(step.begins) > 1
        ]
        others = [
            (step, fact)
            for step in every
            for fact in drawn.leaves
            if fact.split("/")[0] not in {edge.split("/")[0] for edge in step.starts}
        ]
        if not others:
            return
        step, lost = random.choice(others)
        first, second, *_ = places(drawing, step, start)
        turned = [
            f"{name}/{digit}"
            for name in first
            for digit in drawing.branches[name].leaves
            if _value(drawing, first, f"{name}/{digit}")
            != _value(drawing, second, f"{name}/{digit}")
        ]
        values = [one for one in drawing.alphabet(lost) if one != _value(drawing, start, lost)]
        if not turned or not values:
            return
        fact, (name, digit) = random.choice(turned), lost.split("/")
        facts = {fact: _value(drawing, second, fact), lost: random.choice(values)}
        made["blueprint"] = {"_hazards": [{"name": "L", "facts": facts}], **drawn.values}
        drawn.values[name]["_facts"].setdefault(digit, {})["max_age"] = 0.06
        made["world"].setdefault("lasts", {})[step.begins[0]] = 5
        at = {"on": "operation_started", "of": step.begins[0], "plus": 1}
        made["script"] = [{**at, "do": "disturb", "target": lost, "kind": "dropout"}]
        made["asked"]["goals"] = made["goal_states"] = [
            f"{step.edge.split('/')[0]}/{drawing.edges[step.edge][1]}"
        ]

    def _happens(self, random: Random, facts: Json) -> list[Json]:
        """All leaf facts of a hazard, or one, get their values at some time, or one is lost."""
        leaves = [fact for fact in facts if fact in self.drawn.leaves]
        at: Json = {"tick": random.randrange(random.choice([4, 25]))}
        if random.random() < 0.4:
            edge = random.choice(self.drawn.edges)
            at = {"on": "operation_started", "of": edge, "plus": random.randrange(3)}
        if not leaves or random.random() < 0.4:
            for fact in leaves[:1]:
                name, digit = fact.split("/")
                self.drawn.values[name]["_facts"].setdefault(digit, {})["max_age"] = 0.06
            return [{**at, "do": "disturb", "target": one, "kind": "dropout"} for one in leaves[:1]]
        some = leaves if random.random() < 0.6 else leaves[:1]
        act = {**at, "do": "inject", "fault": "set"}
        return [{**act, "with": {"fact": one, "value": facts[one]}} for one in some]

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


def _value(drawing: Drawing, place: dict[str, str], fact: str) -> str:
    name, digit = fact.rsplit("/", 1)
    return drawing.value(place[name], name, int(digit))
