"""Operations per second, each with a trace and a listener.

Three ways of ours. *By hand*: an operation is asked for in the table world; three facts are sensed
twice (before anything moves, and in the tick), source and target states are checked in three
values, it is committed, and six events are told. *A route*: the same as the
dispatcher follows its route through Hanoi with 7 disks, so seven facts. *Believed*: the same route
in a world where nobody senses anything, so that facts are believed: guards, checks of what is
believed, a library function, a commit and four events are left. The peers fire a transition between
three states and call a listener: they know no facts, no guards over them and no outcome; py_trees
ticks a behaviour.

What is kept differs, too: a peer's trace has one word for each operation (sismic's the names of its
steps), ours four or five events with time and addresses. The peers are warm and walk three edges
again and again; a route of ours is the first of its run and uses every edge once.
"""

from __future__ import annotations

import gc
import itertools
import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any

import py_trees
import transitions
from sismic.interpreter import Interpreter  # type: ignore[import-untyped]
from sismic.io import import_from_yaml  # type: ignore[import-untyped]
from statemachine import State, StateMachine

from benches.row import Row, median_ms
from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.generate.rules import hanoi
from smsl_studio.host.local import LocalHost
from smsl_studio.library.loaded import Loaded, Plugin
from smsl_studio.library.operation_library import OperationLibrary

LOOP = (
    Address("SB1", "State_aaa", "Op_1b"),
    Address("SB1", "State_baa", "Op_1c"),
    Address("SB1", "State_caa", "Op_1a"),
)
TIMES, ROUNDS = 300, 10
DISKS = 7
GOAL = Address("SB1", "State_" + "c" * DISKS)


def rows() -> Iterator[Row]:
    """Microseconds for one operation.

    Each round measures everybody once, because a machine may be half as quick a minute later.
    """
    made = hanoi(DISKS)
    measures: dict[str, Callable[[], float]] = {
        "bare dict loop": _timed(_bare()),
        "py_trees": _timed(_behaviours()),
        "transitions": _timed(_transitions()),
        "sismic": _timed(_sismic()),
        "python-statemachine": _timed(_statemachine()),
        "by hand": _timed(_ours()),
        "sensed": lambda: _route(made, "table"),
        "believed": lambda: _route(made, "blind"),
    }
    rounds = [{name: measure() for name, measure in measures.items()} for _ in range(ROUNDS)]
    found = {name: statistics.median(one[name] for one in rounds[1:]) for name in measures}
    peers = tuple(found.items())[:5]
    yield Row("one operation by hand, table world", found["by hand"], "us", peers)
    sensed = (
        "at most 0.8x sismic: not reached, because every sensor is read, and its facts are "
        "compared with the states before and after"
    )
    yield Row("one operation of a route, table world", found["sensed"], "us", peers, sensed)
    promise = (
        "to be 10x quicker than python-statemachine and within 100x of the loop: not reached, "
        "about 4x quicker and within 400x"
    )
    yield Row("one operation of a route, facts believed", found["believed"], "us", peers, promise)


def _timed(work: Callable[[], object]) -> Callable[[], float]:
    return lambda: median_ms(work, runs=1, warmup=0) * 1000 / TIMES


def _ours() -> Callable[[], object]:
    dispatcher = front.open_run(hanoi(3), "table", host="local", automatic=False)
    heard = list(dispatcher.open())

    def work() -> object:
        for address in itertools.islice(itertools.cycle(LOOP), TIMES):
            dispatcher.ask(address)
            heard.extend(dispatcher.tick())
            while dispatcher.phase == "running":
                heard.extend(dispatcher.tick())
        return heard

    return work


def _route(made: Blueprint, world: str) -> float:
    """The time for one operation of a run, from the planned route to the goal."""
    dispatcher = Dispatcher(made, LocalHost(made, world, loaded=_blind()), RunTerms(goals=[GOAL]))
    heard = list(dispatcher.open())
    heard.extend(dispatcher.tick())
    gc.collect()
    begin = time.process_time()
    while not dispatcher.finished:
        heard.extend(dispatcher.tick())
    spent = time.process_time() - begin
    assert dispatcher.status.reason == "goal_reached"
    dispatcher.close()
    return spent * 1e6 / float(2**DISKS - 1)


def _blind() -> Loaded:
    """A world without sensors in which every operation ends at once."""
    library = OperationLibrary("blind")

    @library.world("blind", engine="table", settle=0.0)
    def build(world: Any, blueprint: Any, seed: int) -> None: ...

    @library.operation("{name}")
    def go(world: Any, name: str) -> Iterator[None]:
        return
        yield

    return Loaded((Plugin("blind", "1", "", "bench", "", library),))


def _bare() -> Callable[[], object]:
    table = {branch.name: branch.table for branch in hanoi(3)}["SB1"]
    heard: list[str] = []

    def work() -> object:
        state = "State_aaa"
        for address in itertools.islice(itertools.cycle(LOOP), TIMES):
            state = table[state][address.operation]
            heard.append(state)
        return heard

    return work


def _behaviours() -> Callable[[], object]:
    heard: list[str] = []
    move = py_trees.behaviours.Success(name="move")
    tree = py_trees.trees.BehaviourTree(root=move)
    tree.add_post_tick_handler(lambda one: heard.append(one.root.name))

    def work() -> object:
        for _ in range(TIMES):
            tree.tick()
        return heard

    return work


def _transitions() -> Callable[[], object]:
    heard: list[str] = []
    edges = [
        {"trigger": edge.name, "source": edge.source, "dest": edge.target}
        for edge in hanoi(3)["SB1"].edges()
    ]
    machine: Any = transitions.Machine(
        states=list(hanoi(3)["SB1"].table),
        transitions=edges,
        initial="State_aaa",
        after_state_change=lambda: heard.append(machine.state),
    )

    def work() -> object:
        for address in itertools.islice(itertools.cycle(LOOP), TIMES):
            machine.trigger(address.operation)
        return heard

    return work


CHART = """
statechart:
  name: three
  root state:
    name: root
    initial: aaa
    states:
      - {name: aaa, transitions: [{target: baa, event: move}]}
      - {name: baa, transitions: [{target: caa, event: move}]}
      - {name: caa, transitions: [{target: aaa, event: move}]}
"""


def _sismic() -> Callable[[], object]:
    heard: list[str] = []
    interpreter: Any = Interpreter(import_from_yaml(CHART))
    interpreter.attach(lambda event: heard.append(event.name))
    interpreter.execute()

    def work() -> object:
        for _ in range(TIMES):
            interpreter.queue("move")
            interpreter.execute_once()
        return heard

    return work


def _statemachine() -> Callable[[], object]:
    heard: list[str] = []

    class Three(StateMachine):
        aaa = State(initial=True)
        baa = State()
        caa = State()
        move = aaa.to(baa) | baa.to(caa) | caa.to(aaa)

        def after_move(self) -> None:
            heard.append(str(self.current_state_value))

    machine = Three()

    def work() -> object:
        for _ in range(TIMES):
            machine.send("move")
        return heard

    return work
