"""Operations carried out per second on Hanoi with 3 disks, each with a listener and a trace.

Ours plans nothing here, but senses every fact, checks source and target states in three values,
commits and tells its events; the peers only fire a transition and call back.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import transitions
from statemachine import State, StateMachine

from benches.row import Row, median_ms
from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.generate.rules import hanoi

LOOP = (
    Address("SB1", "State_aaa", "Op_1b"),
    Address("SB1", "State_baa", "Op_1c"),
    Address("SB1", "State_caa", "Op_1a"),
)
TIMES = 300


def rows() -> Iterator[Row]:
    """Microseconds for one operation."""
    peers = (
        ("bare dict loop", _each(_bare)),
        ("transitions", _each(_transitions)),
        ("python-statemachine", _each(_statemachine)),
    )
    yield Row("one operation, table world", _each(_ours), "us", peers)


def _each(make: Callable[[], Callable[[], object]]) -> float:
    return median_ms(make(), runs=5) * 1000 / TIMES


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
