"""Writes a blueprint as a model of PRISM: an MDP in which whoever asks chooses the operation."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.commands import CommandModel, command_model
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.model_names import ModelNames, told_of_models
from smsl_studio.graph.joint.products import JointBox
from smsl_studio.legible import one_line
from smsl_studio.stop import heed


def as_prism(blueprint: Blueprint, findings: ExchangeFindings) -> str:
    """Return a blueprint as an MDP of PRISM. ConvertError if it has no start, or is too large.

    Each SB is a variable, each operation an action. The labels ``goal`` and ``never_...`` name what
    is asked about. The reward ``cost`` is what an operation itself costs.
    """
    model = command_model(blueprint, findings)
    told_of_models(blueprint, findings, ", and costs")
    names = ModelNames(model)
    lines = [
        '// No trap: A [ G (E [ F "goal" ]) ]. No deadlock: A [ G (!"deadlock" | "goal") ].',
        '// A label that begins with never_ names what must not come: A [ G !"never_..." ].',
        "mdp",
        "",
        "module blueprint",
    ]
    for at, known in enumerate(names.branches):
        lines.append(f"    // {one_line(names.order[at])}")
        lines.extend(f"    //   {line}" for line in names.table(model, at))
        top = max(model.numbers.sizes[at] - 1, 1)
        lines.append(f"    {known} : [0..{top}] init {model.start[at]};")
    lines.append("")
    lines.extend(_commands(model, names))
    lines += ["endmodule", "", f'label "goal" = {_inside(model.goal, names)};']
    for known, one in zip(names.forbidden, model.forbidden, strict=True):
        boxes = " | ".join(f"({_inside(box, names)})" for box in one.boxes) or "false"
        lines += [f"// {one_line(one.name)}", f'label "{known}" = {boxes};']
    if model.commands:
        lines += ["", 'rewards "cost"', *_costs(model, names), "endrewards"]
    return "\n".join([*lines, ""])


def _commands(model: CommandModel, names: ModelNames) -> Iterator[str]:
    for command in model.commands:
        heed()
        action = names.action(command.edge.branch, command.edge.name)
        ends = [f"({names.branches[at]}'={end})" for at, end in sorted(command.after.items())]
        yield f"    // {one_line(str(command.edge.address))}"
        yield f"    [{action}] {_inside(command.guard, names)} -> {' & '.join(ends) or 'true'};"


def _costs(model: CommandModel, names: ModelNames) -> Iterator[str]:
    seen = set()
    for command in model.commands:
        edge = command.edge
        if edge.address in seen:
            continue
        seen.add(edge.address)
        at = model.numbers.at[edge.branch]
        source = model.numbers.number[at][edge.source]
        action = names.action(edge.branch, edge.name)
        yield f"    [{action}] {names.branches[at]}={source} : {edge.price:g};"


def _inside(box: JointBox, names: ModelNames) -> str:
    """Return a box of configurations as a condition."""
    parts = [_among(names.branches[at], states) for at, states in sorted(box.items())]
    return " & ".join(parts) or "true"


def _among(known: str, states: Collection[int]) -> str:
    told = "|".join(f"{known}={one}" for one in sorted(states))
    return f"({told})" if len(states) > 1 else told
