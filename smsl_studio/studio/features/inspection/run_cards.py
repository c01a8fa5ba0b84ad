"""What the cards of a counterexample show: for each step and SB the facts."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.studio.base.chips import kind_of

MOST_FACTS, MOST_BRANCHES = 6, 8
Fact = tuple[str, int]


@dataclass(frozen=True)
class CardChip:
    """One fact on a card. A ring marks one that the step changed, a cut corner one that meets the
    hazard."""

    value: str
    kind: str
    sub: bool
    changed: bool
    bad: bool


class RunCards:
    """The rows of all cards. ``branches`` are the SBs that have a row.

    An SB with more than ``MOST_FACTS`` facts shows only those that change in this run. Of more than
    ``MOST_BRANCHES`` SBs only those that move, or that are ``named``, have a row.
    """

    def __init__(
        self, blueprint: Blueprint, steps: Sequence[RunStep], bad: Collection[Fact] = ()
    ) -> None:
        self._blueprint, self.steps, self._bad = blueprint, tuple(steps), frozenset(bad)
        names = list(blueprint.branches)
        moved = {name for step in steps for name in step.changed} | {name for name, _ in bad}
        if len(names) > MOST_BRANCHES:
            names = [name for name in names if name in moved] or names[:1]
        self.branches = tuple(names)
        self.hidden = len(blueprint.branches) - len(names)
        self._digits = {name: self._shown(name) for name in names}

    def chips(self, at: int, branch: str) -> tuple[CardChip, ...]:
        """The facts of an SB at a step, None at the start."""
        found = self._blueprint[branch]
        state = self.steps[at].configuration[branch]
        facts = found.facts(state)
        before: Mapping[str, str] = self.steps[at - 1].configuration if at else {}
        old = found.facts(before[branch]) if before else facts
        last = at == len(self.steps) - 1
        return tuple(
            CardChip(
                facts[digit],
                kind_of(found, state, digit),
                digit in found.subs,
                facts[digit] != old[digit],
                last and (branch, digit) in self._bad,
            )
            for digit in self._digits[branch]
        )

    def words(self, at: int) -> str:
        """A step in words, for assistive tools."""
        step = self.steps[at]
        what = f"{step.operation.operation}" if step.operation else "start"
        states = ", ".join(f"{name} {step.configuration[name]}" for name in self.branches)
        way = f", while {step.during.operation} is carried out" if step.during else ""
        return f"Step {at} of {len(self.steps) - 1}, {what}{way}: {states}"

    def _shown(self, name: str) -> tuple[int, ...]:
        branch = self._blueprint[name]
        count = len(branch.alphabet)
        if count <= MOST_FACTS:
            return tuple(range(count))
        facts = [branch.facts(step.configuration[name]) for step in self.steps]
        moving = [
            digit
            for digit in range(count)
            if (name, digit) in self._bad or len({one[digit] for one in facts}) > 1
        ]
        return tuple(moving[:MOST_FACTS] or range(MOST_FACTS))
