"""Automatic supervisors that lie, hang, crash and flood: nothing begins on what they say.

One process is asked many times. What it says is drawn by a seed; of 40 answers one dies, and one
hangs. Every answer but an approval in the right form has to mean that a person is asked.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from smsl_studio import front
from smsl_studio.front.agents import agent_process
from smsl_studio.front.agents.agent_process import AgentProcess
from smsl_studio.front.agents.asked_agent import asked_agent
from smsl_studio.front.inputs import read
from smsl_studio.library.supervisor_view import ASK, SupervisorView
from smsl_studio.runlog.events import OperationStarted

HOSTILE = 1_000
LIMIT = 0.3
PLUGIN = f"""
import os, random, sys, threading, time

def deep(n):
    found = []
    for _ in range(n):
        found = [found]
    return found

def recurse():
    return recurse()

class Liar(str):
    def __eq__(self, other): return True
    def __hash__(self): return hash("approve")

class Raiser:
    def __repr__(self): raise RuntimeError("no words")

KINDS = (
    lambda d: None, lambda d: d.random(), lambda d: "", lambda d: "go", lambda d: "approve\\n",
    lambda d: " approve", lambda d: "Approve", lambda d: b"approve", lambda d: ("approve",),
    lambda d: ("approve", None), lambda d: ["approve", ""], lambda d: {{"approve": ""}},
    lambda d: "x" * d.randrange(1, 3_000_000), lambda d: deep(d.randrange(1, 90_000)),
    lambda d: Liar("veto"), lambda d: Raiser(), lambda d: 1 / 0, lambda d: recurse(),
    lambda d: sys.exit(0), lambda d: print("y" * 10_000), lambda d: open("/nowhere/at/all").x,
    lambda d: threading.Thread(target=time.sleep, args=(5,)).start(), lambda d: (lambda: 0),
    lambda d: ("approve", "", ""), lambda d: type("A", (), {{}})(), lambda d: float("nan"),
    lambda d: "\\ud800", lambda d: ("go", "approve"), lambda d: os.environ, lambda d: 10**5000,
)

def register(library):
    @library.supervisor("hostile", limit={LIMIT})
    def hostile(view):
        draw = random.Random(view.time)
        if view.time % 40 == 7:
            os._exit(1)
        if view.time % 40 == 21:
            time.sleep(60)
        return draw.choice(KINDS)(draw)
"""


def rows() -> Iterator[Row]:
    """Ask a hostile supervisor, and run a blueprint under it."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "hostile"
        folder.mkdir()
        (folder / "plugin.toml").write_text('name = "hostile"\n', "utf-8")
        (folder / "plugin.py").write_text(PLUGIN, "utf-8")
        agent_process.LIVES = HOSTILE
        asked = AgentProcess([asked_agent("hostile")], [folder])
        approved, longest = 0, 0.0
        try:
            for number in range(HOSTILE):
                began = time.monotonic()
                answer, _ = asked.ask(0, _view(number))
                longest = max(longest, time.monotonic() - began)
                approved += answer != ASK
        finally:
            asked.close()
        yield Row("hostile answers that count", approved, f"of {HOSTILE}", bound="0")
        drawn = read("samples/hanoi-corrected.json")
        done = front.run(drawn, supervisor="hostile", plugin_paths=[folder])
        begun = sum(isinstance(event, OperationStarted) for event in done.events)
        yield Row("operations begun under them", begun, "", bound="0")
        yield Row(
            "the longest answer, with the start of a process after a loss",
            longest * 1000,
            "ms of wall time",
            (("limit", LIMIT * 1000),),
        )


def _view(number: int) -> SupervisorView:
    edge = "SB/State_a/Op"
    return SupervisorView(float(number), {"SB": "State_a"}, edge, (edge,), "State_b", 1.0, "")
