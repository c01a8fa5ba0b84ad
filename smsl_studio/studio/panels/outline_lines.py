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
    def plain(self) -> tuple[object, ...]:
        """The line without its mark: what decides whether the tree must be built anew."""
        return self.depth, self.branch, self.digit, self.text, self.sub, self.file, self.fault

    @property
    def tip(self) -> str:
        if self.fault:
            return self.fault
        if self.digit is None:
            where = f", in {self.file}" if self.file else ""
            return f"State Branch {self.text}, level {self.right}{where}"
        values = f", values {self.right}" if self.right else ""
        return f"Fact {self.digit} of {self.branch}: {self.text}{values}"


FULL = 5_000
"""With so many lines the outline shows what stands below an SB only once."""

DEEPEST = 40
"""So many levels stand below each other; what is deeper begins at the margin again."""


def lines_of(blueprint: Blueprint) -> tuple[Line, ...]:
    """Every line, from top to bottom, without the marks of findings.

    A sub-SB that several SBs share stands below each of them, with all that is below it. Where that
    would be very many lines, it is opened once, and its name alone stands elsewhere.
    """
    outline = _Outline(blueprint)
    for name in _tops(blueprint):
        outline.add(name, 0)
    while outline.cut:
        outline.add(*outline.cut.popitem())
    return (*outline.lines, *map(_failed, blueprint.import_faults))


def marked(lines: Sequence[Line], worst: Mapping[str, str]) -> tuple[Line, ...]:
    """The lines, those of SBs with the gravest of their findings (see ``worst_of``)."""
    return tuple(
        replace(line, severity=worst[line.branch])
        if line.digit is None and line.branch in worst and not line.fault
        else line
        for line in lines
    )


class _Outline:
    """The lines while they are collected; ``cut`` are SBs that were too deep, with their level."""

    def __init__(self, blueprint: Blueprint) -> None:
        self.lines: list[Line] = []
        self.cut: dict[str, int] = {}
        self._blueprint = blueprint
        self._opened: set[str] = set()

    def add(self, name: str, level: int) -> None:
        """An SB at the margin, and all that is below it."""
        if name in self._opened and (level or len(self.lines) >= FULL):
            return
        above: dict[str, Iterator[str]] = {}
        below = self._open(name, level, 0)
        while True:
            if below is not None:
                above[name] = below
            if not above:
                return
            last = next(reversed(above))
            name = next(above[last], "")
            if not name:
                del above[last]
                below = None
            elif name in above:
                below = None
            else:
                below = self._open(name, level + len(above), len(above))

    def _open(self, name: str, level: int, depth: int) -> Iterator[str] | None:
        """Add the line of an SB; its sub-SBs, whose facts are added on the way, None where it is
        not opened."""
        branch = self._blueprint.branches.get(name)
        if branch is None:
            return None
        home = self._blueprint.imported.get(name)
        file = home.file if home is not None else ""
        self.lines.append(Line(2 * depth, name, None, name, str(level), file=file))
        if name in self._opened and len(self.lines) >= FULL:
            return None
        if depth == DEEPEST:
            if name not in self._opened:
                self.cut[name] = level
            return None
        self._opened.add(name)
        self.cut.pop(name, None)
        return self._facts(branch, 2 * depth + 1)

    def _facts(self, branch: StateBranch, depth: int) -> Iterator[str]:
        """Add a line for every fact; the sub-SBs that expand them."""
        for digit in _digits(branch):
            sub = branch.subs.get(digit)
            values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
            right = "" if set(values) <= {"0", "1"} else " ".join(values)
            fact = branch.fact_name(digit)
            self.lines.append(Line(depth, branch.name, digit, fact, right, sub is not None))
            if sub is not None:
                yield sub


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


def worst_of(findings: Sequence[Finding]) -> dict[str, str]:
    """The gravest mark of every SB: errors before warnings; notes are no mark in a tree."""
    found: dict[str, str] = {}
    for finding in findings:
        letter = finding.severity.value
        if letter == "E" or (letter == "W" and found.get(finding.address.branch) != "E"):
            found[finding.address.branch] = letter
    return found
