"""The content of a line of the outline: an SB, one of its facts, or an import that failed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

from smsl_studio.blueprint.model import Blueprint, ImportFault
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.words import capital

SEVERITIES = {"E": "error", "W": "warning"}


@dataclass(frozen=True)
class OutlineLine:
    """A line of the outline: an SB (``digit`` is None) or one of its facts.

    ``right`` is the level of an SB, or the values of a fact if they are not just 0 and 1. ``file``
    is the file of an imported SB, ``sub_name`` the sub-SB of a fact. A line with a ``fault`` is an
    import that failed; its ``right`` says why in a word.
    """

    branch: str
    digit: int | None
    text: str
    right: str
    sub: bool = False
    severity: str = ""
    file: str = ""
    fault: str = ""
    sub_name: str = ""

    @property
    def home(self) -> str:
        """The file name of an imported SB without its folder; empty for the blueprint's own SBs."""
        return PurePath(self.file).name

    @property
    def tip(self) -> str:
        """The tooltip: the SB with level and file, the fact with its values, or the fault."""
        if self.fault:
            return self.fault
        if self.digit is None:
            where = f", in {self.file}" if self.file else ""
            return f"State Branch {self.text}, level {self.right}{where}"
        values = f", values {self.right}" if self.right else ""
        return f"{self.text}, digit {self.digit} of {self.branch}{values}"

    def words(self, above: OutlineLine | None) -> str:
        """The line for a screen reader. It says on which level the line is and what stands above
        it, because a reader hears the lines one below the other. ``above`` is None at the top.
        """
        if self.fault:
            return f"{self.text}, import that failed, {self.right}"
        if self.digit is not None:
            said = [self.text, f"digit {self.digit} of {self.branch}"]
            said += [f"values {self.right}"] if self.right else []
            said += [f"expanded by {self.sub_name}"] if self.sub else []
            return ", ".join(said)
        said = [self.text, "State Branch", f"level {self.right}"]
        said += [f"below {above.text} of {above.branch}"] if above is not None else []
        said += [f"in {self.home}"] if self.home else []
        said += [SEVERITIES[self.severity]] if self.severity else []
        return ", ".join(said)


def branch_line(blueprint: Blueprint, name: str, level: int, severity: str = "") -> OutlineLine:
    """The line of an SB, with the worst severity of its findings (see ``worst_of``)."""
    home = blueprint.imported.get(name)
    file = home.file if home is not None else ""
    return OutlineLine(name, None, name, str(level), severity=severity, file=file)


def fact_line(blueprint: Blueprint, name: str, digit: int) -> OutlineLine:
    """The line of a fact."""
    branch = blueprint.branches[name]
    values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
    right = "" if set(values) <= {"0", "1"} else " ".join(values)
    return OutlineLine(name, digit, branch.fact_name(digit), right, digit in branch.subs,
                       sub_name=branch.subs.get(digit, ""))  # fmt: skip


def fault_line(fault: ImportFault) -> OutlineLine:
    """The line of an import that failed, with the files that led to it."""
    chain = " > ".join(fault.chain)
    told = f"{capital(fault.sentence)} {chain}".strip()
    name = fault.chain[-1] if len(fault.chain) > 1 else "_imports"
    word = "cycle" if name in fault.chain[:-1] else "not read"
    return OutlineLine("", None, name, word, severity="E", fault=told)


def worst_of(findings: Sequence[Finding]) -> dict[str, str]:
    """The worst severity letter of every SB, E before W; notes are not marked in the outline."""
    found: dict[str, str] = {}
    for finding in findings:
        letter = finding.severity.value
        if letter == "E" or (letter == "W" and found.get(finding.address.branch) != "E"):
            found[finding.address.branch] = letter
    return found
