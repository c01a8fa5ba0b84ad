"""What the engines of other programs do not do, although the file holds it."""

from __future__ import annotations

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.findings import ExchangeFindings


def told_of_engines(
    blueprint: Blueprint, engine: str, findings: ExchangeFindings, asks_requires: bool = False
) -> None:
    """Add findings about what another program's engine would do otherwise than Studio.

    The file holds all of it, and Studio reads it back.
    """
    for branch in blueprint:
        notes = branch.notes
        for digit, sub in branch.subs.items():
            words = f"{engine} does not couple this fact with {sub}: SUB_SBS is for Studio alone."
            findings.add("subs", f"{branch.name}/{digit}", words)
        requiring = sum(1 for one in notes.operations.values() if one.requires)
        if requiring and not asks_requires:
            words = f"{engine} does not ask what operations require ({requiring} entries)."
            findings.add("requires", branch.name, words)
        if notes.facts or notes.operations:
            words = (
                f"{engine} does not know _facts and _operations: costs, failures, people, bindings."
            )
            findings.add("annotations", branch.name, words)
        told_of_absent(blueprint, branch.name, findings)
    told_of_imports(blueprint, findings)
    if blueprint.hazards or "_properties" in blueprint.fields:
        words = f"{engine} does not know hazards and properties: they are kept for Studio alone."
        findings.add("hazards", "_hazards", words)


def told_of_imports(blueprint: Blueprint, findings: ExchangeFindings) -> None:
    """Add a finding if SBs of other files are written into one, or could not be read."""
    if blueprint.imported:
        words = "The SBs of imported files are written into this one."
        findings.add("imports", "_imports", words)
    for fault in blueprint.import_faults:
        findings.add("imports", "_imports", f"An import is left out: {fault.sentence}.")


def told_of_absent(blueprint: Blueprint, name: str, findings: ExchangeFindings) -> None:
    """Add a finding for each target of an SB that is no state."""
    branch = blueprint[name]
    for edge in branch.edges():
        if edge.target not in branch.table:
            words = f"The target {edge.target!r} is no state, so this operation is no edge there."
            findings.add("target", str(edge.address), words)
