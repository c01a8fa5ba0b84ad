"""FactMoves: the new place of each fact after the shape of a blueprint has changed.

With it every ``requires``, hazard and property is rewritten for the new shape. It also pairs the
facts of both shapes, so that their behaviour can be compared.
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
"""Takes an SB and a state. Returns the name of the state in the new shape."""


class FactMoves:
    """The new places of facts, to rewrite conditions.

    ``facts`` maps the old place of each moved fact to the new one. ``renamed`` says that plain
    names of facts change. Then conditions must refer to facts by their digits.
    """

    def __init__(
        self, before: Blueprint, facts: Mapping[FactAt, FactAt], renamed: bool = False
    ) -> None:
        self._before, self._renamed = before, renamed
        self.facts = facts

    def follow(self, draft: Draft, state: NewState = lambda branch, state: state) -> None:
        """Rewrite every ``requires``, hazard and property in the draft for the new places."""
        first = next(iter(self._before.branches))

        def term(one: Term) -> Term:
            """Return a comparison for the new shape: with the fact's new place, or the state's new
            name.
            """
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
        """Raise CutRefused if a property would refer to other facts in the new shape."""
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
        """Return the facts before and after the change, each by a common key.

        The behaviour of both shapes can be compared with these keys.
        """
        before: dict[str, FactAt] = {}
        after: dict[str, FactAt] = {}
        for branch in part:
            for digit in range(branch.num_facts):
                key, at = f"{branch.name}/{digit}", (branch.name, digit)
                before[key], after[key] = at, self.facts.get(at, at)
        return before, after


def _facts_of(claim: Property, blueprint: Blueprint) -> list[FactAt | None]:
    """Return the facts to which a property refers. None stands for a fact that does not exist."""
    terms = (term for formula in claim.formulas for term in terms_of(formula))
    return [fact_of(term, blueprint) for term in terms if isinstance(term, FactTerm)]
