"""All steps of a blueprint as guarded commands, for programs that check models.

A configuration is the active state of every SB. A command is one operation that may be asked, with
everything that it takes along: the states that it needs, and the states in which SBs are after it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import NamedTuple

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ConvertError, PlanningError, RunRefused
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import (
    AskedMoves,
    JointBox,
    JointMoves,
    StateNumbers,
    TooLarge,
)
from smsl_studio.graph.joint.products_of import ProductSteps
from smsl_studio.graph.joint.shut import leading_into
from smsl_studio.inspection.proof.claims import claims_of
from smsl_studio.stop import heed

MOST_COMMANDS = 100_000
"""The largest number of commands that are written."""


class GuardedCommand(NamedTuple):
    """One operation. ``guard`` has the states that SBs may be in, ``after`` those they are in."""

    edge: Edge
    guard: Mapping[int, frozenset[int]]
    after: Mapping[int, int]


class Forbidden(NamedTuple):
    """A hazard, or a property of the kind ``never``: boxes of configurations that must not come.

    Those that are only passed stand as the configurations from which a step passes them.
    """

    name: str
    boxes: tuple[JointBox, ...]


class CommandModel(NamedTuple):
    """A whole blueprint as guarded commands. SBs and states are numbers, as in ``numbers``."""

    numbers: StateNumbers
    start: tuple[int, ...]
    goal: JointBox
    commands: tuple[GuardedCommand, ...]
    forbidden: tuple[Forbidden, ...]


def command_model(blueprint: Blueprint, findings: ExchangeFindings) -> CommandModel:
    """Return a blueprint as guarded commands. ConvertError if it has no start, or too many."""
    try:
        hierarchy = Hierarchy(blueprint)
        steps = JointSteps(hierarchy)
        commands = tuple(_commands(steps))
        forbidden = tuple(_forbidden(blueprint, hierarchy, steps, findings))
    except TooLarge as error:
        words = f"as commands it would be more than {error}"
        raise ConvertError(
            words, advice="Convert a part of it: extract, or flatten --sb."
        ) from None
    except (RunRefused, PlanningError) as error:
        words = f"no configuration to start in: {error.sentence}"
        raise ConvertError(words, error.place, error.advice) from None
    numbers = steps.numbers
    goal = {
        numbers.at[root]: frozenset({numbers.number[numbers.at[root]][blueprint[root].activating]})
        for root in hierarchy.roots
    }
    return CommandModel(numbers, steps.start, goal, commands, forbidden)


def _commands(steps: JointSteps) -> Iterator[GuardedCommand]:
    left = MOST_COMMANDS
    for asked in steps.asked:
        for edge in asked.edges:
            heed()
            for one in _of_edge(asked, edge, steps.numbers):
                left -= 1
                if left < 0:
                    raise TooLarge(f"{MOST_COMMANDS:,} commands")
                yield one


def _of_edge(asked: AskedMoves, edge: Edge, numbers: StateNumbers) -> Iterator[GuardedCommand]:
    """Yield the commands of one operation: one for each combination of ends of the other SBs."""
    own = numbers.at[edge.branch]
    pair = numbers.number[own][edge.source], numbers.number[own][edge.target]
    if pair not in asked.moves[own]:
        return
    ways: list[list[tuple[int, frozenset[int], int | None]]] = []
    for at, pairs in asked.moves.items():
        by_end: dict[int | None, set[int]] = {}
        for source, target in [pair] if at == own else sorted(pairs):
            by_end.setdefault(None if source == target else target, set()).add(source)
        ways.append([(at, frozenset(sources), end) for end, sources in by_end.items()])
    for chosen in product(*ways):
        guard = {at: sources for at, sources, _ in chosen}
        yield GuardedCommand(edge, guard, {at: end for at, _, end in chosen if end is not None})


def _forbidden(
    blueprint: Blueprint, hierarchy: Hierarchy, steps: JointSteps, findings: ExchangeFindings
) -> Iterator[Forbidden]:
    passed: list[JointMoves] | None = None
    for claim in claims_of(blueprint):
        address = f"{claim.path[0]}/{claim.name}"
        if claim.meanings is None:
            findings.add("property", address, "It cannot be read, and is left out.")
            continue
        if claim.kind not in ("hazard", "never"):
            words = f"A property of the kind {claim.kind} is left out."
            findings.add("property", address, words)
            continue
        if passed is None:
            written = ProductSteps(hierarchy)
            products = written.products()
            passed = products.passed + (written.exactly_passed() if products.rough else [])
        boxes = steps.boxes(claim.meanings[0], True)
        through = [leading_into(moves, box) for box in boxes for moves in passed]
        yield Forbidden(claim.name, (*boxes, *(one for one in through if one is not None)))
