"""Random arguments for any command, drawn by the types of its parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.people.task import KINDS as TASKS
from smsl_studio.dispatch.supervision.row import (
    AMOUNT,
    DISTURBANCE,
    EDGE,
    SENSED,
    SWITCH,
    TASK,
    TEXT,
    Argument,
)
from smsl_studio.monitor.disturbance import KINDS as DISTURBANCES


def drawn_arguments(
    arguments: Mapping[str, Argument], dice: Random, edges: Sequence[Address], facts: Sequence[str]
) -> dict[str, Any]:
    """A value for each of these arguments. A new kind of argument needs its values here."""
    values: dict[str, Sequence[Any]] = {
        EDGE: edges,
        TEXT: ("at random",),
        AMOUNT: (0.0, 1.0, 2.5),
        SWITCH: (True, True, False),
        SENSED: facts,
        DISTURBANCE: tuple(DISTURBANCES),
        TASK: tuple(TASKS),
    }
    return {name: dice.choice(values[one.kind]) for name, one in arguments.items()}


def needed(arguments: Mapping[str, Argument]) -> dict[str, Argument]:
    """Those that a command cannot do without."""
    return {name: one for name, one in arguments.items() if one.needed}
