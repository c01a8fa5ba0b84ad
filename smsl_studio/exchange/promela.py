"""Writes a blueprint as Promela, which spin checks: deadlocks, hazards, properties of ``never``."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.commands import CommandModel, GuardedCommand, command_model
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.model_names import ModelNames, told_of_models
from smsl_studio.graph.joint.products import JointBox
from smsl_studio.legible import one_line
from smsl_studio.stop import heed


def as_promela(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as Promela. ConvertError if it has no start, or is too large.

    One process takes one operation after another. A configuration without operations that is no
    goal is an invalid end state. Each hazard, and each property of the kind ``never``, is an
    assertion that fails where it is met. It is there if its name is defined, because spin bounds
    the length of formulas.
    """
    model = command_model(blueprint, findings)
    told_of_models(blueprint, findings)
    words = "Traps are not asked: LTL has no formula for 'from everywhere a goal can be reached'."
    findings.add("traps", "", words)
    names = ModelNames(model)
    lines = ["/* Deadlocks: spin -run FILE. What must never be: spin -DNAME -run -E FILE. */"]
    for at, known in enumerate(names.branches):
        lines.append(_comment(f"{known} is {names.order[at]}:"))
        lines.extend(_comment(f"  {line}") for line in names.table(model, at))
        kind = "byte" if model.numbers.sizes[at] <= 255 else "int"
        lines.append(f"{kind} {known} = {model.start[at]};")
    lines.append(f"#define goal ({_inside(model.goal, names)})")
    lines += ["active proctype blueprint() {", "    do"]
    lines.extend(_options(model, names))
    for known, one in zip(names.forbidden, model.forbidden, strict=True):
        boxes = " || ".join(f"({_inside(box, names)})" for box in one.boxes) or "false"
        lines += [f"#ifdef {known}", f"    {_comment(one.name)}"]
        lines += [f"    :: {boxes} -> assert(false)", "#endif"]
    return "\n".join([*lines, "    :: goal -> break", "    od", "}", ""])


def _options(model: CommandModel, names: ModelNames) -> Iterable[str]:
    for command in model.commands:
        heed()
        yield f"    {_comment(str(command.edge.address))}"
        yield f"    :: d_step {{ {_inside(command.guard, names)} -> {_after(command, names)} }}"


def _after(command: GuardedCommand, names: ModelNames) -> str:
    moves = [f"{names.branches[at]} = {end}" for at, end in sorted(command.after.items())]
    return "; ".join(moves) or "skip"


def _inside(box: JointBox, names: ModelNames) -> str:
    """Return a box of configurations as a condition."""
    parts = [_among(names.branches[at], states) for at, states in sorted(box.items())]
    return " && ".join(parts) or "true"


def _among(known: str, states: Collection[int]) -> str:
    told = " || ".join(f"{known} == {one}" for one in sorted(states))
    return f"({told})"


def _comment(text: str) -> str:
    """Return a comment that no name can end."""
    shown = one_line(text).replace("*/", "* /").replace("/*", "/ *")
    return f"/* {shown} */"
