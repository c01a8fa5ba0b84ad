"""A blueprint as a labelled transition system: configurations, and the steps between them.

The label of a step is the name of its operation, with its SB where there are several. The facts of
a configuration have keys of the same kind. So two blueprints can be compared, and a blueprint can
be compared with the single SB that it is flattened to.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import PlanningError
from smsl_studio.inspection.explorer.part import has_more_than
from smsl_studio.inspection.proof.space import Key, Space
from smsl_studio.stop import heed

FactAt = tuple[str, int]
"""An SB and a digit, counted from 0."""
Label = Callable[[Address], str]
"""Gives the label of an operation."""


@dataclass(frozen=True)
class Transitions:
    """All configurations that can be reached from the start, the nearest first, and their steps.

    ``order`` are the SBs in the order of each configuration in ``keys``. ``steps`` has for each
    configuration the operations that may be asked there, with the number of the configuration that
    each leads to. ``bound`` says in words why some are missing; it is empty if there are all.
    ``label`` gives the label of an operation.
    """

    blueprint: Blueprint
    order: tuple[str, ...]
    keys: Sequence[Key]
    steps: Sequence[Sequence[tuple[Address, int]]]
    label: Label
    bound: str = ""

    @cached_property
    def labels(self) -> Sequence[Sequence[tuple[str, int]]]:
        """For each configuration the labels of its steps and where they lead, in order."""
        return [
            sorted({(self.label(address), target) for address, target in steps})
            for steps in self.steps
        ]

    def run_to(self, address: Address) -> tuple[str, ...]:
        """Return the labels of a shortest run that ends with an operation. Empty if there is
        none."""
        came: dict[int, tuple[int, str]] = {}
        for node, steps in enumerate(self.steps):
            for one, target in steps:
                if one == address:
                    found, here = [self.label(one)], node
                    while here:
                        here, label = came[here]
                        found.append(label)
                    return tuple(reversed(found))
                if target:
                    came.setdefault(target, (node, self.label(one)))
        return ()

    def facts(self, keys: Mapping[str, FactAt]) -> Iterator[tuple[str, ...]]:
        """Yield for each configuration the values of some facts, in the order of ``keys``."""
        at = {name: number for number, name in enumerate(self.order)}
        columns = [(at[name], self.blueprint[name], digit) for name, digit in keys.values()]
        for key in self.keys:
            yield tuple(_value(branch, key[place], digit) for place, branch, digit in columns)


def transitions_of(blueprint: Blueprint, limit: int, label: Label | None = None) -> Transitions:
    """Explore a blueprint from its start. At most ``limit`` configurations are stored.

    ``label`` gives the text by which an operation is compared. None means the operation's name,
    with its SB if there are several SBs. Steps that meet a hazard or lead into a failure count,
    too. If it is certain that there are more configurations than ``limit``, nothing is explored.
    RunRefused if there is no start.
    """
    several = len(blueprint.branches) > 1
    label = label or (lambda address: label_of(address, several))
    space = Space(blueprint)
    start, (most, bound) = space.start(), space.storable(limit)
    number, keys = {start: 0}, [start]
    steps: list[list[tuple[Address, int]]] = []
    if has_more_than(blueprint, most):
        return Transitions(blueprint, space.order, keys, [()], label, bound)
    for key in keys:
        heed()
        found: list[tuple[Address, int]] = []
        steps.append(found)
        try:
            onward = space.steps(key)
        except PlanningError as error:
            return Transitions(blueprint, space.order, keys, steps, label, error.sentence)
        for step in onward:
            if step.to not in number:
                if len(keys) >= most:
                    return Transitions(blueprint, space.order, keys, steps, label, bound)
                number[step.to] = len(keys)
                keys.append(step.to)
            found.append((step.address, number[step.to]))
    return Transitions(blueprint, space.order, keys, steps, label)


def label_of(address: Address, several: bool) -> str:
    """Return the label of an operation, in a blueprint of one SB or of several."""
    return f"{address.branch}.{address.operation}" if several else address.operation


def fact_keys(blueprint: Blueprint, named: bool = True) -> dict[str, FactAt]:
    """Return the key of each fact: its plain name or its digit, with the SB if there are several.

    A name that two facts of an SB have is not used. Without ``named`` all keys are digits.
    """
    several = len(blueprint.branches) > 1
    found: dict[str, FactAt] = {}
    for branch in blueprint:
        names = [_plain_name(branch, digit) for digit in range(branch.num_facts)]
        counts = Counter(names)
        taken = {str(digit) for digit in range(branch.num_facts)}
        for digit, name in enumerate(names):
            usable = named and name and counts[name] == 1 and name not in taken - {str(digit)}
            key = name if usable else str(digit)
            found[f"{branch.name}.{key}" if several else key] = branch.name, digit
    return found


def _plain_name(branch: StateBranch, digit: int) -> str:
    note = branch.fact_note(digit)
    return note.name if note else ""


def _value(branch: StateBranch, state: str, digit: int) -> str:
    facts = branch.facts(state)
    return facts[digit] if digit < len(facts) else ""
