"""FactMoves: where each fact stands after the shape of a blueprint has changed.

``requires``, hazards and properties follow, and the facts of both shapes can be compared.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.conditions import (
    conditions_follow,
    moved_facts,
    properties_follow,
)
from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import FactTerm, Term
from smsl_studio.blueprint.properties.follow import terms_of
from smsl_studio.blueprint.properties.meaning import fact_of
from smsl_studio.blueprint.properties.property import Property, properties_of
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.inspection.equivalence.equivalence import Keys
from smsl_studio.inspection.equivalence.transitions import FactAt

NewState = Callable[[str, str], str]
"""Gives the name that a state (SB, state) has afterwards."""


class FactMoves:
    """The new place of each fact that moves, and how conditions follow.

    ``facts`` has the places of the moved facts. ``renamed`` says that facts get other plain names,
    so that conditions have to name them by their digits.
    """

    def __init__(
        self, before: Blueprint, facts: Mapping[FactAt, FactAt], renamed: bool = False
    ) -> None:
        self._before, self._renamed = before, renamed
        self.facts = facts

    def follow(self, draft: Draft, state: NewState = lambda branch, state: state) -> None:
        """Let every ``requires``, hazard and property follow."""
        first = next(iter(self._before.branches))

        def term(one: Term) -> Term:
            """Return a comparison with the new place of its fact, or the new name of its state."""
            if not isinstance(one, FactTerm):
                return replace(one, state=state(one.branch or first, one.state))
            return self._moved(one)

        def goal(one: Address) -> Address:
            """Return a goal with the new name of its state."""
            return replace(one, state=state(one.branch, one.state))

        conditions_follow(draft, lambda facts: moved_facts(facts, self.facts))
        properties_follow(draft, term, goal)

    def _moved(self, term: FactTerm) -> FactTerm:
        fact = fact_of(term, self._before)
        if fact is None or fact not in self.facts:
            return term
        branch, digit = self.facts[fact]
        moved = replace(term, branch=branch if term.branch else "")
        if self._renamed:
            return replace(moved, digit=digit, name="")
        return moved if term.digit is None else replace(moved, digit=digit)

    def must_be_named(self, after: Blueprint) -> None:
        """Raise CutRefused if a property does not name the same facts afterwards."""
        pairs = zip(properties_of(self._before), properties_of(after), strict=True)
        for one, other in pairs:
            named = _facts_of(one, self._before)
            if [self.facts.get(fact, fact) if fact else None for fact in named] != _facts_of(
                other, after
            ):
                raise CutRefused(
                    f"the property {one.name!r} does not say in which State Branch its facts are",
                    None,
                    "Write its facts with State Branch and digit, such as SB/0.",
                )

    def keys(self, part: Blueprint) -> Keys:
        """Return the facts of a part before and after, under the same keys."""
        before: dict[str, FactAt] = {}
        after: dict[str, FactAt] = {}
        for branch in part:
            for digit in range(branch.num_facts):
                key, at = f"{branch.name}/{digit}", (branch.name, digit)
                before[key], after[key] = at, self.facts.get(at, at)
        return before, after


def _facts_of(claim: Property, blueprint: Blueprint) -> list[FactAt | None]:
    """Return the facts that a property names, None for one that does not exist."""
    terms = (term for formula in claim.formulas for term in terms_of(formula))
    return [fact_of(term, blueprint) for term in terms if isinstance(term, FactTerm)]
