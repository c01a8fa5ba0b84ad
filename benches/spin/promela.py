"""Writes a blueprint as Promela: one variable an SB, one atomic step a product step.

The product steps are those of the engine (``graph/joint``), so that both look at the same space.
"""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.joint.products import JointMoves, Pairs, StateNumbers
from smsl_studio.graph.joint.products_of import ProductSteps

Choice = tuple[str, str]
"""A condition on one variable, and what happens to it; both may be empty."""


def promela(blueprint: Blueprint, bad: str) -> str:
    """Return the model of a blueprint with an assertion that ``bad`` never holds.

    ``bad`` names states as ``SB@State``.
    """
    hierarchy = Hierarchy(blueprint)
    numbers = StateNumbers(hierarchy)
    start = numbers.coded(start_configuration(hierarchy, {}))
    for name in hierarchy.order:
        at = numbers.at[name]
        for state, number in numbers.number[at].items():
            bad = bad.replace(f"{name}@{state}", f"(v{at} == {number})")
    lines = [f"byte v{at} = {number};" for at, number in enumerate(start)]
    lines += ["active proctype main() {", "end: do"]
    for step in ProductSteps(hierarchy).products().steps:
        for condition, change in _steps(step, numbers.sizes):
            lines.append(f":: d_step {{ ({condition}) -> {change} assert(!({bad})); }}")
    lines += ["od", "}"]
    return "\n".join(lines) + "\n"


def _steps(step: JointMoves, sizes: list[int]) -> Iterator[Choice]:
    """Yield the atomic steps of a product."""
    found: list[Choice] = [("", "")]
    for at, pairs in sorted(step.items()):
        options = list(_choices(at, pairs, sizes[at]))
        found = [
            (" && ".join(filter(None, (condition, more))), change + act)
            for condition, change in found
            for more, act in options
        ]
    for condition, change in found:
        yield condition or "true", change


def _choices(at: int, pairs: Pairs, size: int) -> Iterator[Choice]:
    """Yield what one SB does in a product, in as few choices as possible."""
    name = f"v{at}"
    by_change: dict[int, list[int]] = {}
    by_end: dict[int, list[int]] = {}
    for one, other in sorted(pairs):
        by_change.setdefault(other - one, []).append(one)
        by_end.setdefault(other, []).append(one)
    if len(by_change) <= len(by_end):
        for change, sources in by_change.items():
            act = f"{name} = {name} + {change};" if change > 0 else f"{name} = {name} - {-change};"
            yield _any(name, sources, size), act if change else ""
        return
    for end, sources in by_end.items():
        yield _any(name, sources, size), f"{name} = {end};"


def _any(name: str, values: list[int], size: int) -> str:
    if len(values) == size:
        return ""
    low, high = min(values), max(values)
    if len(values) > 2 and len(values) == high - low + 1:
        return f"({name} >= {low} && {name} <= {high})"
    return "(" + " || ".join(f"{name} == {value}" for value in values) + ")"
