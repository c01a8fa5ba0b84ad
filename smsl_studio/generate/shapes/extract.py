"""Cuts states out of an SB, and proves that the behaviour stays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import AddressError, PlanningError, UsageError, did_you_mean
from smsl_studio.generate.shapes.chosen import ChosenStates, CutRefused
from smsl_studio.generate.shapes.cut import Cut, cuts
from smsl_studio.generate.shapes.extraction import extracted, fact_moves
from smsl_studio.inspection.equivalence.equivalence import ComparedView, equivalence
from smsl_studio.inspection.equivalence.transitions import transitions_of
from smsl_studio.inspection.explorer.part import restricted, touching

MOST_ALIKE = 500
"""The largest number of operations from one state to another that are cut out together."""


def cut_out(
    blueprint: Blueprint, branch: str, states: Collection[str], name: str, limit: int
) -> tuple[Blueprint, Cut]:
    """Return the blueprint with some states of an SB as a sub-SB, and how they were cut out.

    CutRefused, with a run that shows why, if it would not behave alike. AddressError if there is
    no such state, EditRefused if the name is not free. PlanningError if more than
    ``limit`` configurations can be reached, RunRefused if there is no start.
    """
    chosen_of = blueprint[branch]
    unknown = next((one for one in states if one not in chosen_of.table), None)
    if unknown is not None:
        raise AddressError(
            f"{branch} has no state {unknown!r}", advice=did_you_mean(unknown, chosen_of.table)
        )
    if not states:
        raise UsageError("no state is chosen", advice="Name at least one state.")
    try:
        return next(alike(blueprint, ChosenStates(chosen_of, states), name, limit))
    except CutRefused as error:
        if error.at is None or error.run:
            raise
        run = transitions_of(touching(blueprint, branch), limit, _short).run_to(error.at)
        raise CutRefused(error.sentence, error.at, error.advice, run) from None


def alike(
    blueprint: Blueprint, chosen: ChosenStates, name: str, limit: int
) -> Iterator[tuple[Blueprint, Cut]]:
    """Yield the blueprints that behave as before, with how the states were cut out, the best first.

    CutRefused instead if there is none.
    """
    refusal: CutRefused | None = None
    found = False
    for cut in cuts(chosen):
        _must_be_small(cut)
        try:
            after = extracted(blueprint, cut, name)
        except CutRefused as error:
            refusal = refusal or error
            continue
        before = touching(blueprint, chosen.branch.name)
        names = [one for one in after.branches if one == name or one in before.branches]
        view = ComparedView(fact_moves(blueprint, cut, name).keys(before), (_short, _short))
        told = equivalence(before, restricted(after, names), limit, view)
        if told.equal:
            found = True
            yield after, cut
        elif told.equal is None:
            raise PlanningError(f"nothing was cut out: {told.reason}", advice="Raise --limit.")
        else:
            words = f"the result would behave otherwise: {told.reason}"
            refusal = refusal or CutRefused(words, None, "", told.path)
    if not found:
        assert refusal is not None
        raise refusal


def _must_be_small(cut: Cut) -> None:
    """Raise PlanningError if too many operations lead the same way: each is planned over all."""
    for edges in (cut.exits, cut.returns):
        most = max(Counter(edge.source for edge in edges).values(), default=0)
        if most > MOST_ALIKE:
            raise PlanningError(
                f"nothing was cut out: {most:,} operations lead from one state to another, and at "
                f"most {MOST_ALIKE:,} are compared",
                advice="Give operations that do the same one name.",
            )


def _short(address: Address) -> str:
    return address.operation
