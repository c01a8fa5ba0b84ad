"""What the outline shows, line by line: SBs by level, their facts, sub-SBs below their fact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.finding import Finding


@dataclass(frozen=True)
class Line:
    """One line: an SB (``digit`` is None) or one of its facts; ``depth`` counts from 0.

    ``right`` is the SB's level, or the values of a fact that has more than 0 and 1.
    """

    depth: int
    branch: str
    digit: int | None
    text: str
    right: str
    sub: bool = False
    severity: str = ""

    @property
    def plain(self) -> Line:
        """The line without its mark: what decides whether the tree must be built anew."""
        return replace(self, severity="", right="")

    @property
    def tip(self) -> str:
        if self.digit is None:
            return f"State Branch {self.text}, level {self.right}"
        values = f", values {self.right}" if self.right else ""
        return f"Fact {self.digit} of {self.branch}: {self.text}{values}"


def lines_of(blueprint: Blueprint, findings: Sequence[Finding]) -> tuple[Line, ...]:
    """Every line, from top to bottom."""
    worst = _worst(findings)
    return tuple(line for name in _tops(blueprint) for line in _branch(blueprint, name, worst, ()))


def _branch(
    blueprint: Blueprint, name: str, worst: Mapping[str, str], path: tuple[str, ...]
) -> Iterator[Line]:
    branch = blueprint.branches.get(name)
    if branch is None or name in path:
        return
    depth = 2 * len(path)
    yield Line(depth, name, None, name, str(len(path)), severity=worst.get(name, ""))
    for digit in _digits(branch):
        sub = branch.subs.get(digit)
        values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
        right = "" if set(values) <= {"0", "1"} else " ".join(values)
        yield Line(depth + 1, name, digit, branch.fact_name(digit), right, sub is not None)
        if sub is not None:
            yield from _branch(blueprint, sub, worst, (*path, name))


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
