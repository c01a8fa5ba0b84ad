"""Facts whose sources, ranges and predicates cannot be used (part of R29)."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.known_values import values_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.inspection.rules.finding import Remark, Severity
from smsl_studio.inspection.rules.words import fact_words

_KEPT = "it is kept in the file, and the fact is unknown in every run"


def odd_predicates(blueprint: Blueprint, branch: StateBranch) -> Iterator[Remark]:
    """Report what is wrong with the predicates of an SB.

    It is an error if a fact is unknown for this in every run, because nobody may miss it.
    """
    for digit, sense in branch.notes.senses.items():
        if digit >= branch.num_facts:
            continue
        fact = fact_words(branch, digit)
        for fault in sense.faults:
            yield _remark(
                blueprint,
                branch,
                (str(digit), *fault.path),
                f"{fact}: {fault.sentence}",
                f"{_lower(fault.advice)}; {_KEPT}" if fault.grave else _lower(fault.advice),
                Severity.ERROR if fault.grave else Severity.WARNING,
            )
        if sense.fault is None:
            yield from _values(blueprint, branch, digit, sense)
            yield from _idle_sensors(blueprint, branch, digit)


def _values(
    blueprint: Blueprint, branch: StateBranch, digit: int, sense: FactSense
) -> Iterator[Remark]:
    """Report values that no state has, and values of states that no predicate leads to."""
    fact, known = fact_words(branch, digit), values_of(branch, digit)
    said = [one.value for one in sense.predicates]
    for value in said:
        if value not in known:
            yield _remark(
                blueprint,
                branch,
                (str(digit), "predicate", value),
                f"{fact}: no state has the value {value}, for which there is a predicate",
                f"the values are {', '.join(known)}",
                Severity.WARNING,
            )
    missing = [value for value in branch.alphabet[digit] if value not in said]
    if missing:
        yield _remark(
            blueprint,
            branch,
            (str(digit), "predicate"),
            f"{fact}: no predicate says when it is {' or '.join(missing)}, so it is never sensed",
            "write a predicate for each value",
            Severity.WARNING,
        )


def _idle_sensors(blueprint: Blueprint, branch: StateBranch, digit: int) -> Iterator[Remark]:
    """Report sensors that no run asks, because predicates decide."""
    note = branch.fact_note(digit)
    if note is not None and note.sensors:
        yield _remark(
            blueprint,
            branch,
            (str(digit), "sensors"),
            f"{fact_words(branch, digit)}: its sensors are not asked, its predicates decide",
            "name what measures it under sources, or take the predicates away",
            Severity.WARNING,
        )


def _remark(
    blueprint: Blueprint,
    branch: StateBranch,
    path: tuple[str, ...],
    message: str,
    advice: str,
    severity: Severity,
) -> Remark:
    spot = blueprint.home(branch.name), (branch.name, "_facts", *path)
    return Remark("R29", severity, branch.address, message, advice, spot=spot)


def _lower(advice: str) -> str:
    """Return an advice as a part of a sentence: messages have their advice after a semicolon."""
    said = advice.removesuffix(".")
    return said[:1].lower() + said[1:]
