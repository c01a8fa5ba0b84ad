"""The run that shows why something fails, step by step."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.errors import StudioError
from smsl_studio.inspection.proof.verdict import Counterexample


@dataclass(frozen=True)
class RunStep:
    """One moment of a counterexample. ``operation`` is None at the start.

    ``configuration`` has the active state of each SB afterwards. ``changed`` are the SBs that it
    moved. ``edges`` are all edges that it carried out. ``during`` is the edge that is carried out
    at this moment, if the configuration is not committed.
    """

    operation: Address | None
    configuration: Mapping[str, str]
    changed: frozenset[str] = frozenset()
    edges: tuple[Address, ...] = ()
    during: Address | None = None


def steps_of(blueprint: Blueprint, run: Counterexample) -> tuple[RunStep, ...]:
    """Return the start and every step of a counterexample. It ends early if the blueprint does not
    permit a step."""
    here = dict(run.start)
    found = [RunStep(None, here)]
    try:
        stepper = Stepper(Hierarchy(blueprint), Terms(failing=None))
    except StudioError:
        return tuple(found)
    for number, address in enumerate(run.path, 1):
        step = _step(stepper, here, address)
        if step is None:
            break
        last = number == len(run.path)
        during = run.during if last else None
        after = dict(run.end) if during is not None else {**here, **step.after}
        changed = frozenset(name for name in after if after[name] != here[name])
        edges = tuple(edge.address for edge in step.edges)
        found.append(RunStep(address, after, changed, edges, during))
        here = after
    return tuple(found)


def script_of(blueprint: Blueprint, steps: Sequence[RunStep]) -> str:
    """Return a script that asks for the operations of a run by hand, one after the other.

    It is the text of a file for ``run --script``. Each operation is asked for when the one before
    it has ended: when its target becomes active for the right time.
    """
    lines: list[dict[str, object]] = [{"do": "by_hand"}]
    arrivals = Counter((name, state) for name, state in steps[0].configuration.items())
    moment: dict[str, object] = {}
    for step in steps[1:]:
        asked = step.operation
        assert asked is not None
        lines.append({**moment, "do": "ask", "address": str(asked)})
        for edge in step.edges:
            arrivals[edge.branch, _target(blueprint, edge)] += 1
        target = _target(blueprint, asked)
        times = arrivals[asked.branch, target]
        moment = {"when": str(Address(asked.branch, target)), "times": times}
    return "".join(f"{json.dumps(line, ensure_ascii=False)}\n" for line in lines)


def _target(blueprint: Blueprint, edge: Address) -> str:
    return blueprint[edge.branch].table[edge.state][edge.operation]


def _step(stepper: Stepper, here: Mapping[str, str], address: Address) -> JointStep | None:
    state = here.get(address.branch, "")
    for edge in stepper.edges.out(address.branch, state):
        if edge.address == address:
            found = stepper.step(here, edge)
            return found if isinstance(found, JointStep) else None
    return None
