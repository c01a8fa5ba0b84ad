"""Open comments of a review as findings, for the engineer in Draw."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import AddressError
from smsl_studio.inspection.review.review import Review, ReviewComment
from smsl_studio.inspection.rules.finding import Finding, Severity

ASKED = "ask"
"""Stands in place of the rule."""
MOST = 200
"""At most so many comments are listed; Review has all of them."""


def asked_findings(
    blueprint: Blueprint, review: Review
) -> tuple[tuple[Finding, ReviewComment], ...]:
    """The open comments, each with the finding that stands for it in the list."""
    found = []
    for comment in review.open_comments[:MOST]:
        address = _address(blueprint, comment)
        if address is None:
            continue
        entry = comment.entry
        who = f"{entry.person}, {entry.role}" if entry.role else entry.person
        answered = " (answered)" if comment.is_answered else ""
        message = f"{who} asks about “{entry.heading}”{answered}: {entry.text}"
        place = blueprint.place(address)
        found.append((Finding(ASKED, Severity.WARNING, address, place, message), comment))
    return tuple(found)


def _address(blueprint: Blueprint, comment: ReviewComment) -> Address | None:
    """The first element of the comment's line that still exists, else the first SB."""
    for text in comment.entry.about:
        try:
            return blueprint.resolve(text)
        except AddressError:
            continue
    first = next(iter(blueprint), None)
    return None if first is None else Address(first.name)
