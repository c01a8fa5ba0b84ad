"""What forms with states and operations alone do not hold, listed."""

from __future__ import annotations

from collections.abc import Collection

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.exchange.engines import told_of_imports
from smsl_studio.exchange.findings import ExchangeFindings

_FILE_WORDS = {
    "_hazards": "Hazards are",
    "_properties": "Properties are",
    "_levels": "Levels are",
    "_risk": "The parts of a risk are",
    "_notes": "Notes are",
    "_origin": "The origin is",
    "_conflicts": "Conflicts of a merge are",
}
_BRANCH_WORDS = {
    "_facts": "What facts mean and how they are sensed are",
    "_states": "Titles and notes of states are",
    "_operations": "What operations cost, require and are bound to are",
    "_layout": "Places of states and lines are",
    "_groups": "Groups are",
    "_notes": "Notes are",
    "_origin": "The origin is",
    "_sources": "The sources of states and operations are",
}


def told_of_left_out(
    blueprint: Blueprint,
    findings: ExchangeFindings,
    held: Collection[str] = (),
    operations: str = "",
) -> None:
    """Add a finding for everything of a blueprint that a form of states and operations leaves out.

    ``held`` are the keys that the form holds after all: ``_`` fields, or ``SUB_SBS``.
    ``operations`` says what of ``_operations`` it holds, empty for nothing.
    """
    told_of_imports(blueprint, findings)
    for key in blueprint.fields:
        if key not in held and key != "_imports":
            words = _FILE_WORDS.get(key, f"The field {key} is")
            findings.add(key.strip("_"), key, f"{words} left out.")
    for branch in blueprint:
        _of_branch(branch, findings, (*held, "_operations") if operations else held)
        if operations and "_operations" in branch.fields:
            words = f"Of _operations it has {operations}. The rest is left out."
            findings.add("operations", branch.name, words)


def _of_branch(branch: StateBranch, findings: ExchangeFindings, held: Collection[str]) -> None:
    for digit, sub in branch.subs.items():
        if "SUB_SBS" not in held:
            words = f"That {sub} expands this fact is left out."
            findings.add("subs", f"{branch.name}/{digit}", words)
    for key in branch.fields:
        if key not in held:
            words = _BRANCH_WORDS.get(key, f"The field {key} is")
            findings.add(key.strip("_"), branch.name, f"{words} left out.")
    for key in (*branch.header.unknown, *branch.header.fields):
        findings.add("header", branch.name, f"The header key {key} is left out.")
    for state, fields in branch.state_fields.items():
        words = f"The fields {', '.join(fields)} of a state are left out."
        findings.add("field", f"{branch.name}/{state}", words)
