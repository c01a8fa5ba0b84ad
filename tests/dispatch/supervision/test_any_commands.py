"""Random commands at random ticks to random blueprints, and what must hold in every run.

It uses a seeded twentieth of the cases of the bench.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.route.goals import goals_of
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import RunRefused
from smsl_studio.host.local import LocalHost
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.protocol import Host, OpenedWorld, Outcome
from smsl_studio.runlog.events import (
    Commanded,
    Committed,
    Event,
    FactChanged,
    OperationStarted,
    StateChecked,
)
from tests.cases import case
from tests.counts import share_of
from tests.dispatch.arguments import drawn_arguments, needed
from tests.dispatch.fake_host import FakeHost, Fault
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import Story, blueprint, sample
from tests.dispatch.supervision.runs import host_of

SEEDS = range(300)
RUNS = share_of(50)
TICKS = 120
STILL = ("paused", "taken_over", "stopped", "no_route", "fault_hold", "waiting")
WORDS = tuple(word for word in COMMANDS if word not in ("answer", "disturb"))
"""Nobody is asked in these runs, and a ``FakeHost`` has no sensors to disturb."""
HELPS: dict[str, tuple[str, ...]] = {
    "ready": ("ask", "step", "resume"),
    "running": ("veto", "pause", "full_map", "inject"),
    "paused": ("resume", "step"),
    "stopped": ("reset",),
    "taken_over": ("give_back", "accept", "accept", "repair"),
    "fault_hold": ("resume", "adopt", "repair", "ask"),
    "no_route": ("restore", "resume"),
}
"""What a sensible person would say; without it a run would soon stand still for good."""

Said = tuple[str, dict[str, Any]]


class Sloppy(FakeHost):
    """Operations take their time, and some fail in every way there is."""

    def __init__(self, made: Blueprint, dice: random.Random) -> None:
        edges = [edge.address for branch in made for edge in branch.edges()]
        outcomes = (Outcome.FAILED, Outcome.RAISED, Outcome.RETURNED, Outcome.RETURNED)
        covered = {str(edge): {(edge.branch, 0): None} for edge in edges}
        faults = {
            edge: Fault(dice.choice(outcomes), dice.choice((None, {}, covered[edge])),
                        hangs=dice.random() < 0.2)
            for edge in covered if dice.random() < 0.3
        }  # fmt: skip
        stop = dice.choice(("hold", "abort", "finish"))
        lasts, settle = dice.randint(1, 4), dice.choice((0.0, 0.2))
        super().__init__(made, faults, lasts=lasts, settle=settle, stop=stop)
        self.resumes = dice.random() < 0.7

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        opened = super().open(start)
        self._good = dict(self.facts)
        return opened

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Somebody moves a thing, or covers a sensor, or puts all back where it stood."""
        if fault == "repair":
            self.facts.update(self._good)
            return
        key = sorted(self.facts)[int(fault) % len(self.facts)]
        covered = "0" if int(fault) > 5 else None
        self.facts[key] = covered if self.facts[key] == "1" else "1"


def drawn(story: Story, dice: random.Random) -> list[Said]:
    """What is said ahead of one tick, mostly nothing; of edges mostly those that may be used."""
    status = story.dispatcher.status
    edges = [edge.address for branch in story.blueprint for edge in branch.edges()]
    near = [one.address for one in status.possible] or edges
    shut = [one.address for one in status.possible if one.pruned or one.risky] or edges
    said: list[Said] = []
    while dice.random() < 0.3 and len(said) < 3:
        word = dice.choice(WORDS)
        if dice.random() < 0.7:
            word = dice.choice(HELPS.get(status.phase, WORDS))
        edge = dice.choice(near if dice.random() < 0.8 else edges)
        given: dict[str, dict[str, Any]] = {
            "veto": {} if dice.random() < 0.5 else {"address": edge},
            "ask": {"address": edge},
            "restore": {"address": dice.choice(shut)},
            "set_cost": {"address": edge, "cost": float(dice.randint(0, 5))},
            "inject": {"fault": str(dice.randint(0, 9))},
            "full_map": {"on": True},
            "repair": {"fault": "repair"},
        }
        row = COMMANDS["inject" if word == "repair" else word]
        more = drawn_arguments(needed(row.arguments), dice, [edge], ["ONE/0"])
        said.append((row.word, given.get(word, more)))
    return said


def play(made: Blueprint, host: Host, seed: int, **choices: Any) -> list[tuple[str, list[Event]]]:
    """A run under random commands; of every tick the state it left the run in, and its events."""
    dice = random.Random(f"commands {seed}")
    story = Story(made, host, attended=True, **choices)
    told = [(story.phase, list(story.events))]
    for _ in range(TICKS):
        if story.dispatcher.finished:
            break
        words = drawn(story, dice)
        before = len(story.events)
        for word, parameters in words:
            getattr(story.dispatcher, word)(**parameters, by="Dice")
        story.tick()
        events = story.events[before:]
        answers = [one for one in events if isinstance(one, Commanded)]
        assert sorted(one.command for one in answers) == sorted(word for word, _ in words)
        told.append((story.phase, events))
    return told


def random_blueprint(seed: int) -> Blueprint | None:
    """One that takes some operations to its goals, where the seed gives such a one."""
    made = blueprint(blueprint_values(seed))
    hierarchy = Hierarchy(made)
    try:
        start = start_configuration(hierarchy, {})
    except RunRefused:
        return None
    legs = Planner(hierarchy).legs(start, goals_of(hierarchy, ()))
    return made if sum(len(leg.operations) for leg in legs or ()) > 2 else None


def test_no_command_breaks_a_run() -> None:
    found = 0
    for seed in SEEDS:
        made = random_blueprint(seed)
        if made is not None and found < RUNS:
            found += 1
            with case("of seed", seed):
                _check_run(made, seed)
    assert found >= min(RUNS, 39)


def _check_run(made: Blueprint, seed: int) -> None:
    def once() -> list[tuple[str, list[Event]]]:
        return play(made, Sloppy(made, random.Random(seed)), seed, automatic=seed % 3 > 0)

    told = once()
    _nothing_begins_while_it_stands_still(told)
    _every_commit_was_checked(made, [event for _, events in told for event in events])
    assert once() == told


def _nothing_begins_while_it_stands_still(told: Sequence[tuple[str, list[Event]]]) -> None:
    """No edge begins in a tick that finds the run standing still, unless that tick's own commands
    let it go on; and stop and take over are at once."""
    for (before, _), (after, events) in pairwise(told):
        done = [e.command for e in events if isinstance(e, Commanded) and not e.refused]
        began = [e for e in events if isinstance(e, OperationStarted)]
        if before in STILL and not {"resume", "step", "ask", "adopt", "set_automatic"} & set(done):
            assert not began, (before, done)
        if "stop" in done or "take_over" in done:
            assert not began
            assert after in ("stopped", "taken_over", "fault_hold")
        if before in ("stopped", "taken_over") and began:
            assert {"reset", "accept"} & set(done), "only what unlatches it lets it go on"


def _every_commit_was_checked(made: Blueprint, events: Sequence[Event]) -> None:
    """Every SB that commits by an edge was checked true on sensed facts, and they read so."""
    sensed: dict[FactKey, str | None] = {}
    true: set[str] = set()
    for event in events:
        if isinstance(event, FactChanged):
            sensed[event.branch, event.digit] = event.value
        elif isinstance(event, StateChecked):
            (true.add if event.result == "true" else true.discard)(event.address)
        elif isinstance(event, Committed):
            for name, state in event.configuration.items():
                assert f"{name}/{state}" in true
                for digit, value in enumerate(made[name].facts(state)):
                    if digit not in made[name].subs:
                        assert sensed[name, digit] == value


def test_stop_take_over_and_pause_are_read_before_the_next_step_of_the_world() -> None:
    """100 random tries: no tick of the host lies between the command and what it did."""
    made = blueprint({"ONE": {f"S{n}": {"go": f"S{(n + 1) % 10}"} for n in range(10)}})
    for seed in range(share_of(100)):
        dice = random.Random(seed)
        story = Story(made, FakeHost(made, lasts=3), attended=True, goals=["ONE/S9"])
        story.tick(dice.randint(1, 25))
        word = dice.choice(("stop", "take_over", "pause"))
        ticks = host_of(story).now
        getattr(story.dispatcher, word)()
        before = len(story.events)
        story.tick()
        events = story.events[before:]
        assert events[0].event == "commanded"
        assert all(event.t == events[0].t for event in events if event.event != "fact_changed")
        assert story.phase == {"stop": "stopped", "take_over": "taken_over"}.get(word, "paused")
        moved = host_of(story).now - ticks
        assert moved == (0 if word == "pause" else 1), "a world that is braked lives, a paused not"


def test_both_hosts_tell_the_same_story_under_the_same_commands() -> None:
    """Commands, disturbances and faults in the world too: equal traces, here and in a child."""
    made = sample("hanoi-corrected")
    child = ProcessHost(made, "table", 3)
    try:
        for seed in range(6):
            here = _table_run(made, LocalHost(made, "table", 3), seed)
            assert here == _table_run(made, child, seed)
            assert len(here) > 3
    finally:
        child.close()


def _table_run(made: Blueprint, host: Host, seed: int) -> list[str]:
    dice = random.Random(seed)
    story = Story(made, host, attended=True, seed=3)
    assert story.dispatcher.opened is not None
    for _ in range(80):
        if story.dispatcher.finished:
            break
        for word, parameters in drawn(story, dice):
            getattr(story.dispatcher, word)(**parameters)
        if dice.random() < 0.1:
            kind = dice.choice(("noise", "dropout", "stuck", "none", "nonsense"))
            story.dispatcher.disturb(dice.choice(("SB1/0", "SB1/2", "SB1/9")), kind)
        if dice.random() < 0.1:
            fault = dice.choice((*story.dispatcher.opened.world_faults, "meteor"))
            given: dict[str, dict[str, str]] = {
                "set": {"fact": "SB1/0", "value": dice.choice("abc")},
                "elsewhere": {"state": f"SB1/{dice.choice(list(made['SB1'].table))}"},
            }
            story.dispatcher.inject(fault, **given.get(fault, {}))
        story.tick()
    return [event.line() for event in story.events]
