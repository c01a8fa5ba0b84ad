"""5,000 seeded faults of seven kinds in 50 intact files: how many of them ``check`` finds.

A fault is found if an error or a warning appears that the intact file does not have. The files are
the made ones of ``tests/inspection/intact.py`` and the samples without errors. ``python -m
benches.seeded --write`` puts the table into docs/inspection.md: with the rules before R20 to R23
and R28 came, with all rules, and compared with the intact file (R27). It also writes how many each
rule found into resources/rule_scores.json; records carry this score.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.inspect import RULES, inspect
from smsl_studio.inspection.rules.finding import Finding, Severity
from tests.inspection.intact import intact_files, read
from tests.inspection.seeded import KINDS, seeded_faults

COUNT, SEED = 5_000, 2026
NEW = ("R20", "R21", "R22", "R23", "R28")
COLUMNS = ("before", "now", "now, with `--against`")
SCORES = Path(__file__).parent.parent / "resources" / "rule_scores.json"
PAGE = Path(__file__).parent.parent / "docs" / "inspection.md"
BEGIN, END = "<!-- seeded faults: begin -->\n", "<!-- seeded faults: end -->\n"


def rows() -> Iterator[Row]:
    """Count the faults that are found, by kind."""
    counts = found(Counter())
    for kind in KINDS:
        seeded, *shares = counts[kind]
        before, now, against = (100 * share / seeded for share in shares)
        words = f"before {before:.0f} %, with --against {against:.0f} %"
        yield Row(f"seeded faults found: {kind}, of {seeded} ({words})", now, "%")


def found(by_rule: Counter[str], count: int = COUNT, seed: int = SEED) -> dict[str, list[int]]:
    """Return for each kind the number of faults, and how many are found in each column. Count in
    ``by_rule`` how many each rule finds.
    """
    files = intact_files()
    sound = {name: read(values) for name, values in files.items()}
    known = {name: marks(inspect(blueprint)) for name, blueprint in sound.items()}
    counts = {kind: [0, 0, 0, 0] for kind in KINDS}
    for fault in seeded_faults(files, count, seed):
        blueprint = read(fault.values)
        new = marks(inspect(blueprint)) - known[fault.file]
        counts[fault.kind][0] += 1
        counts[fault.kind][1] += any(rule not in NEW for rule, *_ in new)
        counts[fault.kind][2] += bool(new)
        against = _against(blueprint, sound[fault.file])
        counts[fault.kind][3] += bool(new) or bool(against)
        by_rule.update({rule for rule, *_ in new} | {one.rule for one in against})
    return counts


def marks(findings: tuple[Finding, ...]) -> set[tuple[str, str, str]]:
    """Return the errors and warnings as values that can be compared."""
    return {
        (one.rule, str(one.address), one.message)
        for one in findings
        if one.severity is not Severity.NOTE
    }


def _against(blueprint: Blueprint, other: Blueprint) -> tuple[Finding, ...]:
    from smsl_studio.inspection.against import inspect_against

    return inspect_against(blueprint, other)


def scores(by_rule: Counter[str]) -> str:
    """Return the content of the file of scores."""
    told = {rule: by_rule[rule] for rule in sorted(RULES)}
    return json.dumps({"faults": COUNT, "seed": SEED, "found": told}, indent=1) + "\n"


def table(by_rule: Counter[str]) -> str:
    """Return the table as Markdown."""
    lines = [f"| fault | seeded | {' | '.join(COLUMNS)} |", "|---|---|---|---|---|"]
    total: Counter[int] = Counter()
    for kind, counts in found(by_rule).items():
        total.update(dict(enumerate(counts)))
        lines.append(_line(kind, counts))
    lines.append(_line("all", [total[n] for n in range(4)]))
    return "\n".join(lines) + "\n"


def _line(kind: str, counts: list[int]) -> str:
    seeded, *shares = counts
    cells = (kind, f"{seeded:,}", *(f"{n:,} ({100 * n // seeded} %)" for n in shares))
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    rules: Counter[str] = Counter()
    made = table(rules)
    print(made, end="")
    if "--write" in sys.argv:
        page = PAGE.read_text("utf-8")
        head, rest = page.split(BEGIN)[0], page.split(END)[1]
        SCORES.write_text(scores(rules), "ascii")
        PAGE.write_text(f"{head}{BEGIN}{made}{END}{rest}", "utf-8")
