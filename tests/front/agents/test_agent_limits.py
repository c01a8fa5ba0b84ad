"""What a supervisor that hangs costs: its limit, and no more. The clock is told, not waited for."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest

from smsl_studio.front.agents import agent_process
from smsl_studio.front.agents.agent_child import READY
from smsl_studio.front.agents.agent_process import LIVES, LOOK, AgentProcess
from smsl_studio.front.agents.asked_agent import asked_agent
from smsl_studio.library.supervisor_view import ASK, SupervisorView

LIMIT = 0.3
EDGE = "SB/State_a/Near"
VIEW = SupervisorView(0.0, {"SB": "State_a"}, EDGE, (EDGE,), "State_c", 1.0, "")


@dataclass
class World:
    """A clock, and the children that were started. ``chatter`` lets them say all the time that they
    load, and ``late`` is how much longer than asked each look takes (s).
    """

    now: float = 100.0
    late: float = 0.0
    chatter: bool = False
    children: list[Hanging] = field(default_factory=list)

    def start(self, _module: str) -> Hanging:
        self.children.append(Hanging(self))
        return self.children[-1]


class Hanging:
    """A child process that loads, takes its questions, and never answers one."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._opened: list[Any] = []
        self.looks = 0
        self.killed = False
        self.wire = SimpleNamespace(send=lambda *_: None)

    def tell(self, verb: str, _arguments: Any) -> None:
        assert verb == "open"
        ready = READY.encode((("hangs", LIMIT, False),))
        self._opened.append(SimpleNamespace(kind="ok", body=ready))

    def told(self) -> None: ...

    def heard(self, seconds: float) -> Any:
        if self._opened:
            return self._opened.pop()
        self.looks += 1
        self._world.now += seconds + self._world.late
        return SimpleNamespace(kind="loads", body=b"") if self._world.chatter else None

    def kill(self) -> None:
        self.killed = True

    release = kill


@pytest.fixture
def world(monkeypatch: pytest.MonkeyPatch) -> World:
    made = World()
    monkeypatch.setattr(agent_process, "start_child", made.start)
    monkeypatch.setattr(agent_process, "time", SimpleNamespace(monotonic=lambda: made.now))
    return made


def opened() -> AgentProcess:
    process = AgentProcess([asked_agent("hangs")])
    process.open()
    return process


@pytest.mark.parametrize("chatter", [False, True])
def test_a_supervisor_that_hangs_costs_its_limit_and_no_more(world: World, chatter: bool) -> None:
    """Each question takes exactly the limit. Its process is killed, and the next one is begun."""
    world.chatter = chatter
    process = opened()
    for number in range(1, LIVES + 1):
        begun = world.now
        assert process.ask(0, VIEW) == (ASK, "it gave no answer in 0.3 s")
        assert world.now - begun == pytest.approx(LIMIT)
        assert [one.killed for one in world.children[:number]] == [True] * number
    begun, count = world.now, len(world.children)
    answer, why = process.ask(0, VIEW)
    assert (answer, why) == (ASK, "it is not asked any more: it gave no answer in 0.3 s")
    assert (world.now, len(world.children)) == (begun, count) == (begun, LIVES)


def test_on_a_machine_that_is_late_a_hang_costs_one_look_more(world: World) -> None:
    """Each look takes 0.5 s longer than it was asked for, so one look is over the limit."""
    process = opened()
    world.late = 0.5
    begun = world.now
    assert process.ask(0, VIEW)[0] == ASK
    assert world.now - begun == pytest.approx(LOOK + 0.5)
    assert world.children[0].looks == 1
