"""Inspection: applies every rule to a blueprint and returns the findings in the order of the text.

docs/inspection.md describes each rule.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import partial
from types import MappingProxyType
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.inspection.rules import (
    bottleneck,
    effects,
    header,
    levels,
    look_alikes,
    loop,
    reach,
    recovery,
    reverses,
    sources,
    titles,
)
from smsl_studio.inspection.rules import text as writing
from smsl_studio.inspection.rules.finding import Finding, Remark
from smsl_studio.inspection.selection import listed
from smsl_studio.smsl.garbage import uncollected
from smsl_studio.stop import heed


class Rule(NamedTuple):
    """A rule: its number, a few words about the fault that it finds, and its function."""

    id: str
    words: str
    check: Callable[[Blueprint], Iterator[Remark]]


ALL = (
    Rule("R01", "a key written twice", writing.r01_doubled_key),
    Rule("R02", "a target that is no state", writing.r02_unknown_target),
    Rule("R03", "a header that names nothing", header.r03_header_names_nothing),
    Rule("R04", "a header left to defaults", header.r04_left_to_default),
    Rule("R05", "names that do not carry facts", header.r05_fact_strings),
    Rule("R06", "states with equal facts", header.r06_equal_facts),
    Rule("R07", "sub-SBs that do not fit", levels.r07_sub_sbs),
    Rule("R08", "a cycle among SBs or imports", levels.r08_cycles),
    Rule("R09", "names that look alike", look_alikes.r09_look_alikes),
    Rule("R10", "a state that cannot be reached", reach.r10_unreachable),
    Rule("R11", "a trap", reach.r11_traps),
    Rule("R12", "a dead end", reach.r12_dead_ends),
    Rule("R13", "a sub-SB that cannot serve", levels.r13_sub_cannot_serve),
    Rule("R14", "a base and its sub-SB at odds", levels.r14_mixed),
    Rule("R15", "a mislabelled operation", effects.r15_mislabelled),
    Rule("R16", "a conditional effect", effects.r16_conditional),
    Rule("R17", "a self loop not marked as repeatable", effects.r17_self_loops),
    Rule("R18", "parallel operations without costs", effects.r18_parallel),
    Rule("R20", "a way back that is missing", recovery.r20_no_way_back),
    Rule("R21", "a failure without recovery", recovery.r21_no_recovery),
    Rule("R22", "a single point of failure", bottleneck.r22_single_points),
    Rule("R23", "a loop without a bound", loop.r23_unbounded_loop),
    Rule("R28", "an operation without its reverse", reverses.r28_missing_reverse),
    Rule("R29", "an annotation not understood", writing.r29_annotations),
    Rule("R31", "a title that a report needs", titles.r31_missing_titles),
    Rule("R32", "a part without a source", sources.r32_no_source),
)
PROVED = {
    "R19": "a combination of facts that must not be",
    "R20": "a way back that is missing",
    "R30": "another property that fails or is unknown",
}
"""The rules about hazards and properties. ``proof`` finds what they report."""
WITH_MORE = {
    "R24": "an operation without a function in the world, or beyond its robot's reach",
    "R25": "a fact that is not sensed in the world",
    "R26": "a grave operation that nobody confirms",
    "R27": "a change since another version",
}
"""The rules that need more than the blueprint. ``in_world`` and ``against`` check them."""
RULES: Mapping[str, str] = MappingProxyType(
    dict(sorted({**{rule.id: rule.words for rule in ALL}, **PROVED, **WITH_MORE}.items()))
)
"""The number of each rule and a few words about it."""


def inspect(blueprint: Blueprint, rules: Collection[str] | None = None) -> tuple[Finding, ...]:
    """Return the findings of the rules about a blueprint, in the order of the text.

    ``rules`` has the numbers of the rules to check, such as ``R15``. None means all rules. An
    unknown number raises UsageError.
    """
    for name in rules or ():
        if name not in RULES:
            raise UsageError(
                f"there is no rule {name!r}",
                advice=did_you_mean(name, RULES) or f"Choose of {', '.join(RULES)}.",
            )
    found: list[Finding] = []
    with uncollected():
        for rule in ALL:
            if rules is None or rule.id in rules:
                heed()
                found.extend(listed(blueprint, rule.check(blueprint)))
    return in_order(blueprint, found)


def in_order(blueprint: Blueprint, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the text."""
    return tuple(sorted(findings, key=partial(order, blueprint)))


def order(blueprint: Blueprint, finding: Finding) -> tuple[object, ...]:
    """The sort key: the blueprint's own file first, then imported files, each from top to
    bottom."""
    place = finding.place
    at = (place.file != blueprint.file, place)
    return (*at, finding.rule, finding.address, finding.message)
