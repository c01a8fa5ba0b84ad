"""Random runs that lose one fact at a random tick, compared with their events.

The observer below shares no code with the dispatcher. It knows the samples and the commits, and
tells where a run began, committed or ended although it must not have.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.front.inputs import refusals
from smsl_studio.runlog.events import Event
from tests.counts import share_of
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import blueprint

Plain = dict[str, Any]
Fact = tuple[str, int]
SKIP = "skip"


def guarded(seed: int) -> Plain:
    """A random blueprint with critical facts, stop modes, and more that is required."""
    values, dice = blueprint_values(seed), random.Random(seed * 7 + 1)
    for sb in values.values():
        count = sb["HEADER"]["NUM_FACTS"]
        sb["_facts"] = {str(d): {"critical": True} for d in range(count) if dice.random() < 0.3}
        for name in (f"o{number}" for number in range(6)):
            note = sb["_operations"].setdefault(name, {})
            note["stop"] = dice.choice(["hold", "abort", "finish"])
            if dice.random() < 0.2:
                other = dice.choice(list(values))
                digit = dice.randrange(values[other]["HEADER"]["NUM_FACTS"])
                note.setdefault("requires", {})[f"{other}/{digit}"] = dice.choice("01")
    return values


class Observer:
    """``wrong`` has what must never happen. Facts that a step changes are not judged meanwhile."""

    def __init__(self, plain: Plain) -> None:
        self.plain = plain
        self.sensed: dict[Fact, str | None] = {}
        self.here: dict[str, str] = {}
        self.running: set[str] = set()
        self.changing: set[Fact] = set()
        self.lost: dict[str, list[str]] = {}
        self.acted = -1.0
        self.holds = False
        self.wrong: list[str] = []

    def subs(self, sb: str) -> dict[int, str]:
        return {digit: sub for sub, digit in self.plain[sb]["HEADER"]["SUB_SBS"].items()}

    def fact(self, sb: str, digit: int, wanted: str) -> bool | str | None:
        if (sb, digit) in self.changing:
            return SKIP
        sub = self.subs(sb).get(digit)
        if sub is None:
            read = self.sensed[sb, digit]
            return None if read is None else read == wanted
        truth = self.check(sub, self.plain[sub]["HEADER"]["ACTIVATING"])
        return truth if truth in (None, SKIP) else truth == (wanted == "1")

    def check(self, sb: str, state: str) -> bool | str | None:
        found = [self.fact(sb, digit, value) for digit, value in enumerate(state[1:])]
        if SKIP in found:
            return SKIP
        return False if False in found else None if None in found else True

    def critical(self) -> Iterator[str]:
        for sb, own in self.plain.items():
            for key in own["_facts"]:
                if self.fact(sb, int(key), self.here[sb][1:][int(key)]) not in (True, SKIP):
                    yield f"critical {sb}/{key}"

    def required(self, edge: str) -> Iterator[str]:
        sb, _, name = edge.split("/")
        for key, value in self.plain[sb]["_operations"][name].get("requires", {}).items():
            other, digit = key.split("/")
            if self.fact(other, int(digit), value) not in (True, SKIP):
                yield f"{edge} requires {key}"

    def moved(self, edge: str, target: str) -> Iterator[Fact]:
        sb, source, name = edge.split("/")
        loads = self.plain[sb]["_operations"][name].get("subs") == "load"
        for digit, (old, new) in enumerate(zip(source[1:], target[1:], strict=True)):
            if old != new:
                yield sb, digit
                sub = self.subs(sb).get(digit)
                if loads and sub is not None:
                    yield from self.below(sub)

    def below(self, sb: str) -> Iterator[Fact]:
        yield from ((sb, digit) for digit in range(self.plain[sb]["HEADER"]["NUM_FACTS"]))
        for sub in self.subs(sb).values():
            yield from self.below(sub)

    def hear(self, event: Any) -> None:
        name = f"_{event.event}"
        if hasattr(self, name):
            getattr(self, name)(event)

    def tick_over(self) -> None:
        """What runs now and has lost what it rests on must never commit."""
        for edge in self.running:
            lost = [*self.critical(), *self.required(edge)]
            if lost:
                self.lost.setdefault(edge, lost)

    def _run_started(self, event: Any) -> None:
        self.here = dict(event.start)

    def _fact_changed(self, event: Any) -> None:
        self.sensed[event.branch, event.digit] = event.value

    def _operation_started(self, event: Any) -> None:
        lost = [*self.critical(), *self.required(event.address)]
        self.running.add(event.address)
        self.changing |= set(self.moved(event.address, event.target))
        if lost or self.holds:
            self.wrong.append(f"{event.t} {event.address} began, holds {self.holds}, {lost}")

    def _committed(self, event: Any) -> None:
        for edge in event.operations:
            if edge in self.lost:
                self.wrong.append(f"{event.t} {edge} committed after {self.lost[edge]}")
        self.running -= set(event.operations)
        self.here.update(event.configuration)
        self.acted = event.t
        if not self.running:
            self.changing = set()
        for sb, state in event.configuration.items():
            if self.check(sb, state) not in (True, SKIP):
                self.wrong.append(f"{event.t} {sb}/{state} committed without a true check")

    def _over(self, event: Any) -> None:
        self.running, self.changing, self.lost = set(), set(), {}

    def _relocalised(self, event: Any) -> None:
        self._over(event)
        self.here = dict(event.configuration)

    def _held(self, event: Any) -> None:
        self._over(event)
        self.holds = True

    def _commanded(self, event: Any) -> None:
        self.acted = event.t
        if not event.refused:
            self.holds = False

    def _goal_reached(self, event: Any) -> None:
        sb, state = event.goal.split("/")
        true = self.here[sb] == state and self.check(sb, state) is True
        if not true or self.holds or event.t <= self.acted or any(self.critical()):
            self.wrong.append(f"{event.t} {event.goal} told, {self.here}, holds {self.holds}")

    def _run_finished(self, event: Any) -> None:
        if event.reason == "goal_reached" and event.t <= self.acted:
            self.wrong.append(f"{event.t} ended without a check after {self.acted}")


def run(plain: Plain, goal: Address, fault: tuple[int, Fact, str | None] | None) -> list[Event]:
    """A run of operations of four ticks; at some tick one fact is changed or cannot be read."""
    made = blueprint(plain)
    told: list[Event] = []
    host = FakeHost(made, lasts=4, stop=random.Random(str(plain)).choice(["hold", "finish"]))
    dispatcher = Dispatcher(made, host, RunTerms(goals=[goal], attended=fault is not None))
    observer = Observer(plain)
    events = dispatcher.open()
    for tick in range(200):
        for event in events:
            observer.hear(event)
        told.extend(events)
        observer.tick_over()
        if dispatcher.finished:
            break
        if fault is not None and tick == fault[0]:
            host.facts[fault[1]] = fault[2]
        if tick == 120:
            dispatcher.resume()
        if tick == 150:
            dispatcher.leave()
        events = dispatcher.tick()
    assert dispatcher.finished, "the run does not end"
    assert observer.wrong == []
    return told


def test_wherever_one_fact_is_lost_nothing_is_begun_committed_or_told_on_it() -> None:
    kinds: dict[str, int] = {}
    for seed in range(share_of(120, least=60)):
        plain, dice = guarded(seed), random.Random(seed)
        made = blueprint(plain)
        if refusals(made):
            continue
        facts = [(b.name, d) for b in made for d in range(b.num_facts) if d not in b.subs]
        for _ in range(3):
            name = dice.choice(list(made.branches))
            goal = Address(name, dice.choice(list(made[name].table)))
            well = run(plain, goal, None)
            if well[-1].t < 0.3 or well[-2].event != "goal_reached":
                continue
            ticks = round(well[-1].t / 0.05)
            for _ in range(8):
                value = dice.choice(["0", "1", None, None])
                for event in run(plain, goal, (dice.randrange(ticks), dice.choice(facts), value)):
                    kind = getattr(event, "kind", "") or getattr(event, "reason", "")
                    if event.event in ("held", "run_finished"):
                        kinds[kind] = kinds.get(kind, 0) + 1
    assert kinds["guard_lost"] > 20
    assert kinds["goal_unconfirmed"] > 2
    assert kinds["goal_reached"] > 50
