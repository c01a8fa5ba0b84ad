"""Hazards, clause 16: facts that must never hold together, in plans and on sensed facts.

A *place* of a step is where everything stands after one of its functions: what has moved counts,
committed or not; an edge without a function has moved when all subs that it changes have crossed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from tests.oracle.carriage import put_below
from tests.oracle.drawing import Drawing
from tests.oracle.scene import Scene, all_of
from tests.oracle.search import Carriage
from tests.oracle.standing import Configuration


def places(drawing: Drawing, step: Carriage, here: Mapping[str, str]) -> Iterator[Configuration]:
    """Where everything stands after each function of a step."""
    now = dict(here)
    quiet = [edge for edge in step.starts if edge not in step.begins]
    for function in step.begins:
        now[function.split("/", 1)[0]] = drawing.edges[function][1]
        if drawing.kind(function) == "load":
            put_below(drawing, function, now)
        moved = True
        while moved:
            moved = False
            for edge in quiet:
                name = edge.split("/", 1)[0]
                source, target = drawing.edges[edge]
                if now[name] == source != target and _subs_stand(drawing, edge, now):
                    now[name], moved = target, True
        yield dict(now)


def _subs_stand(drawing: Drawing, edge: str, now: Mapping[str, str]) -> bool:
    """Whether all subs that an edge changes stand as its target has them."""
    branch = drawing.branches[edge.split("/", 1)[0]]
    falls, rises = drawing.changed_subs(edge)
    return all(
        (now[branch.subs[digit]] == drawing.branches[branch.subs[digit]].activating)
        == (digit in rises)
        for digit in (*falls, *rises)
    )


def planned_in(drawing: Drawing, place: Mapping[str, str]) -> list[str]:
    """The hazards that a configuration meets."""

    def value(fact: str) -> str:
        name, digit = fact.rsplit("/", 1)
        return drawing.value(place[name], name, int(digit))

    return [
        name
        for name, facts in drawing.hazards.items()
        if all(value(fact) == wanted for fact, wanted in facts.items())
    ]


def passes(drawing: Drawing, step: Carriage, here: Mapping[str, str]) -> list[str]:
    """The hazards that a step meets in one of its places."""
    if not drawing.hazards:
        return []
    return [one for place in places(drawing, step, here) for one in planned_in(drawing, place)]


class Facts:
    """Facts as they are sensed, while SBs stand as ``flags`` has them.

    ``moved`` are SBs with the states that are declared for them: all their facts are as these
    states have them. ``transit`` are the digits in transit, which are as their base's state;
    ``vague`` are facts that a function moves now, so that nobody can tell them: those in transit
    and those without a sensor.
    """

    def __init__(
        self,
        drawing: Drawing,
        scene: Scene,
        flags: Mapping[str, str],
        transit: Iterable[str],
        moved: Mapping[str, str],
        vague: Iterable[str] = (),
    ) -> None:
        self.drawing, self.scene, self.flags = drawing, scene, flags
        self.transit, self.moved, self.vague = set(transit), moved, set(vague)

    def holds(self, fact: str, wanted: str) -> bool | None:
        """Whether a fact has a value; None where it is unknown."""
        name, digit = fact.rsplit("/", 1)
        number, branch = int(digit), self.drawing.branches[name]
        if name in self.moved:
            return self.drawing.value(self.moved[name], name, number) == wanted
        if fact in self.vague:
            return None
        if number not in branch.subs:
            return self.scene.says(fact, wanted, self.flags)
        if fact in self.transit:
            return self.drawing.value(self.flags[name], name, number) == wanted
        sub = self.drawing.branches[branch.subs[number]]
        there = all_of(
            self.holds(f"{sub.name}/{d}", value)
            for d, value in enumerate(sub.facts[sub.activating])
        )
        if there is None:
            return None
        if wanted == branch.on[number]:
            return there
        off = sorted({facts[number] for facts in branch.facts.values()} - {branch.on[number]})
        return not there and wanted in off

    def met(self) -> dict[str, bool | None]:
        """For each hazard whether it is met; None where an unknown fact could complete it."""
        return {
            name: all_of(self.holds(fact, value) for fact, value in facts.items())
            for name, facts in self.drawing.hazards.items()
        }


def changed(drawing: Drawing, before: Mapping[str, str], after: Mapping[str, str]) -> set[str]:
    """The facts in which two configurations differ."""
    return {
        f"{name}/{digit}"
        for name, state in after.items()
        for digit, value in enumerate(drawing.branches[name].facts[state])
        if value != drawing.value(before[name], name, digit)
    }


def objections(
    drawing: Drawing,
    scene: Scene,
    here: Mapping[str, str],
    way: Iterable[Configuration],
    transit: Iterable[str] = (),
) -> dict[str, str]:
    """Why what leads over these places must not begin: the hazards, each with a sentence.

    What has moved is declared, everything else is as it is sensed now.
    """
    way = list(way)
    found: dict[str, str] = {}
    sensed = [Facts(drawing, scene, here, transit, {}).met()]
    touched: set[str] = set()
    moving: set[str] = set()
    last: Mapping[str, str] = here
    for place in way:
        moving |= {name for name in place if place[name] != last[name]}
        moved = {name: place[name] for name in moving}
        open_digits = set(transit) | in_transit(drawing, here, place)
        sensed.append(Facts(drawing, scene, here, open_digits, moved).met())
        touched |= changed(drawing, last, place)
        last = place
        found |= {one: "would be met" for one, so in sensed[-1].items() if so is True}
    for one, facts in drawing.hazards.items():
        if touched & set(facts) and any(met[one] is None for met in sensed):
            found.setdefault(one, "could be met by an unknown fact")
    return found


def in_transit(drawing: Drawing, here: Mapping[str, str], place: Mapping[str, str]) -> set[str]:
    """The digits of bases that have not moved, of subs that have crossed."""
    found = set()
    for sub, bases in drawing.bases.items():
        active = drawing.branches[sub].activating
        if (here[sub] == active) != (place[sub] == active):
            found |= {f"{base}/{digit}" for base, digit in bases if place[base] == here[base]}
    return found
