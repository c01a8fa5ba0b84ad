"""What the outline shows, line by line: SBs by level, their facts, sub-SBs below their fact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath

from smsl_studio.blueprint.model import Blueprint, ImportFault, StateBranch
from smsl_studio.inspection.finding import Finding
from smsl_studio.studio.words import capital


@dataclass(frozen=True)
class Line:
    """One line: an SB (``digit`` is None) or one of its facts; ``depth`` counts from 0.

    ``right`` is the SB's level, or the values of a fact that has more than 0 and 1. ``file`` is
    where an SB stands that is imported. A line with a ``fault`` is an import that failed, and no
    SB; ``right`` says why in a word.
    """

    depth: int
    branch: str
    digit: int | None
    text: str
    right: str
    sub: bool = False
    severity: str = ""
    file: str = ""
    fault: str = ""

    @property
    def home(self) -> str:
        """The name of the file an imported SB stands in; empty for the blueprint's own."""
        return PurePath(self.file).name

    @property
    def plain(self) -> Line:
        """The line without its mark: what decides whether the tree must be built anew."""
        return replace(self, severity="", right="")

    @property
    def tip(self) -> str:
        if self.fault:
            return self.fault
        if self.digit is None:
            where = f", in {self.file}" if self.file else ""
            return f"State Branch {self.text}, level {self.right}{where}"
        values = f", values {self.right}" if self.right else ""
        return f"Fact {self.digit} of {self.branch}: {self.text}{values}"


def lines_of(blueprint: Blueprint, findings: Sequence[Finding]) -> tuple[Line, ...]:
    """Every line, from top to bottom."""
    worst = _worst(findings)
    lines = [line for name in _tops(blueprint) for line in _branch(blueprint, name, worst, ())]
    return (*lines, *map(_failed, blueprint.import_faults))


def _branch(
    blueprint: Blueprint, name: str, worst: Mapping[str, str], path: tuple[str, ...]
) -> Iterator[Line]:
    branch = blueprint.branches.get(name)
    if branch is None or name in path:
        return
    depth = 2 * len(path)
    home = blueprint.imported.get(name)
    file = home.file if home is not None else ""
    yield Line(depth, name, None, name, str(len(path)), False, worst.get(name, ""), file)
    for digit in _digits(branch):
        sub = branch.subs.get(digit)
        values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
        right = "" if set(values) <= {"0", "1"} else " ".join(values)
        yield Line(depth + 1, name, digit, branch.fact_name(digit), right, sub is not None)
        if sub is not None:
            yield from _branch(blueprint, sub, worst, (*path, name))


def _failed(fault: ImportFault) -> Line:
    """An import that failed, with the files that led to it."""
    chain = " > ".join(fault.chain)
    told = f"{capital(fault.sentence)} {chain}".strip()
    name = fault.chain[-1] if len(fault.chain) > 1 else "_imports"
    word = "cycle" if name in fault.chain[:-1] else "not read"
    return Line(0, "", None, name, word, severity="E", fault=told)


def _digits(branch: StateBranch) -> range:
    return range(branch.num_facts if branch.table else 0)


def _tops(blueprint: Blueprint) -> tuple[str, ...]:
    """The roots, and what only a cycle or an unknown base names, so that nothing is hidden."""
    shown = set(blueprint.roots)
    for name in blueprint.roots:
        stack = [name]
        while stack:
            branch = blueprint.branches.get(stack.pop())
            for sub in branch.subs.values() if branch else ():
                if sub not in shown:
                    shown.add(sub)
                    stack.append(sub)
    rest = [name for name in blueprint.branches if name not in shown]
    return (*blueprint.roots, *rest)


def _worst(findings: Sequence[Finding]) -> dict[str, str]:
    """The gravest mark of every SB: errors before warnings; notes are no mark in a tree."""
    found: dict[str, str] = {}
    for finding in findings:
        letter = finding.severity.value
        if letter == "E" or (letter == "W" and found.get(finding.address.branch) != "E"):
            found[finding.address.branch] = letter
    return found
