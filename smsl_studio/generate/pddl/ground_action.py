"""Actions with objects for their parameters, in the order of the domain and of the objects."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.errors import UsageError
from smsl_studio.generate.pddl.domain import ActionSchema
from smsl_studio.generate.pddl.expressions import Expression
from smsl_studio.generate.pddl.formulas import Compiler, Condition, Effect, Given
from smsl_studio.stop import heed

MOST_ACTIONS = 50_000
"""The largest number of actions with all their objects."""
MOST_TRIED = 2_000_000
"""The largest number of choices of objects that are tried."""


@dataclass(frozen=True, slots=True)
class GroundAction:
    """An action of certain objects. ``when`` is None if it is always possible."""

    name: str
    when: Condition | None
    effects: tuple[Effect, ...]
    cost: float | None


def ground_actions(compiler: Compiler, actions: Sequence[ActionSchema]) -> list[GroundAction]:
    """Return all actions that facts which never change permit.

    UsageError if there are too many, or if two of them get the same name.
    """
    found: dict[str, GroundAction] = {}
    tried = [0]
    for action in actions:
        parts = _parts(action.precondition)
        _check(compiler, action)
        for given in _choices(compiler, action, parts, tried):
            name = "_".join((action.name, *given.values()))
            if name in found:
                raise action.at.fault(
                    f"two actions would have the name {name}",
                    "Rename the action, or an object with _ in its name.",
                )
            when = compiler.conjunction(parts, given)
            if when is False:
                continue
            effects, cost = compiler.effects(action.effect, given)
            condition = None if isinstance(when, bool) else when
            found[name] = GroundAction(name, condition, tuple(effects), cost)
            if len(found) > MOST_ACTIONS:
                raise UsageError(
                    f"there are more than {MOST_ACTIONS:,} actions with all their objects",
                    advice="Take a smaller problem.",
                )
    return list(found.values())


def _check(compiler: Compiler, action: ActionSchema) -> None:
    """Raise ReadError for a fault in an action, also where no objects fit its parameters."""
    ranges = [compiler.members(one) for one in action.parameters]
    if all(ranges):
        given = {one.name: own[0] for one, own in zip(action.parameters, ranges, strict=True)}
        compiler.checks_only = True
        compiler.conjunction(_parts(action.precondition), given)
        compiler.effects(action.effect, given)
        compiler.checks_only = False


def _parts(condition: Expression | None) -> list[Expression]:
    """Return the parts of a condition that must all hold."""
    found: list[Expression] = []
    waiting = [condition] if condition is not None else []
    while waiting:
        heed()
        one = waiting.pop(0)
        if one.head == "and":
            waiting = [*one.rest, *waiting]
        else:
            found.append(one)
    return found


def _choices(
    compiler: Compiler, action: ActionSchema, parts: Sequence[Expression], tried: list[int]
) -> Iterator[Given]:
    """Give the objects of the parameters, those left out that facts forbid which never change."""
    names = [one.name for one in action.parameters]
    ranges = [compiler.members(one) for one in action.parameters]
    tests: list[list[Expression]] = [[] for _ in range(len(names) + 1)]
    for part in parts:
        if compiler.unchanging(part):
            used = compiler.variables(part)
            last = max((at + 1 for at, name in enumerate(names) if name in used), default=0)
            tests[last].append(part)

    def chosen(given: dict[str, str]) -> Iterator[Given]:
        heed()
        tried[0] += 1
        if tried[0] > MOST_TRIED:
            raise UsageError(
                f"more than {MOST_TRIED:,} choices of objects were tried for the actions",
                advice="Take fewer objects, or fewer parameters for each action.",
            )
        if not all(compiler.condition(part, given) for part in tests[len(given)]):
            return
        if len(given) == len(names):
            yield dict(given)
            return
        name = names[len(given)]
        for value in ranges[len(given)]:
            yield from chosen({**given, name: value})

    yield from chosen({})
