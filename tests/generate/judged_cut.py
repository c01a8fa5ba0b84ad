"""A random cut, judged by plain steps and a plain bisimulation that share no code with the
program."""

from __future__ import annotations

from typing import Any, NamedTuple

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.front.shapes import extract, inline
from smsl_studio.generate.shapes.chosen import CutRefused
from tests.generate.cut_cases import CutCase
from tests.inspection.equivalence.plain import System, after, bisimilar, naive_system

Json = Any
LIMIT = 20_000


class JudgedCut(NamedTuple):
    """How a cut ended (``cut``, ``inlined`` or ``refused``), and what is wrong with it."""

    end: str
    wrong: str = ""


def judged_cut(case: CutCase) -> JudgedCut:
    """Cut, put back, and compare each result with the origin."""
    origin = system_of(case.origin)
    try:
        cut = extract(case.origin, case.branch, case.states, "NEW", LIMIT)
    except CutRefused as error:
        possible = after(origin, error.run[:-1])
        wrong = "" if possible else f"the run {error.run} cannot be carried out"
        return JudgedCut("refused", wrong)
    if len(cut[case.branch].table) != len(case.origin[case.branch].table) - len(case.states) + 1:
        return JudgedCut("cut", "the base has another number of states")
    if len(cut["NEW"].table) != len(case.states) + 1:
        return JudgedCut("cut", "the sub-SB has another number of states")
    if not bisimilar(origin, system_of(cut)):
        return JudgedCut("cut", "the result behaves otherwise")
    try:
        back = inline(cut, "NEW", LIMIT)
    except EditRefused:
        return JudgedCut("cut")
    if not bisimilar(origin, system_of(back, case.branch)):
        return JudgedCut("inlined", "what was put back behaves otherwise")
    return JudgedCut("inlined")


def system_of(blueprint: Blueprint, inlined: str = "") -> System:
    """The transition system, labels cut to names of operations.

    In the SB ``inlined`` these begin with the name of the SB from which they come.
    """

    def label(sb: str, name: str) -> str:
        own = name.partition("@")[0]
        return own.partition(".")[2] if sb == inlined else own

    start = start_configuration(Hierarchy(blueprint), {})
    plain = {branch.name: plain_branch(blueprint, branch.name) for branch in blueprint}
    begin = {name: f"S{''.join(blueprint[name].facts(state))}" for name, state in start.items()}
    nodes, rows = naive_system(plain, begin, label)
    names = {
        branch.name: [branch.fact_name(digit).rpartition(".")[2] for digit in
                      range(branch.num_facts)]
        for branch in blueprint
    }  # fmt: skip
    facts = [
        tuple(
            sorted(
                (name, value)
                for sb, values in node
                for name, value in zip(names[sb], values, strict=True)
                if name != "NEW"
            )
        )
        for node in nodes
    ]
    return facts, rows


def plain_branch(blueprint: Blueprint, name: str) -> Json:
    """An SB whose states are named by their facts, and each of whose operations has a name of its
    own, with all notes that hold for it."""
    branch = blueprint[name]
    named = {state: f"S{''.join(branch.facts(state))}" for state in branch.table}
    assert len(set(named.values())) == len(named), "alike states"
    notes, table = {}, {}
    for state, row in branch.table.items():
        table[named[state]] = {f"{op}@{state}": named[target] for op, target in row.items()}
        for op in row:
            note = branch.operation_note(state, op)
            cost = 1 if note.cost is None else note.cost
            notes[f"{op}@{state}"] = {
                "cost": cost, "subs": note.subs, "requires": dict(note.requires)
            }  # fmt: skip
    header = {
        "INITIAL": named[branch.initial],
        "ACTIVATING": named[branch.activating],
        "SUB_SBS": {sub: digit for digit, sub in branch.subs.items()},
    }
    return {"HEADER": header, "_operations": notes, **table}
