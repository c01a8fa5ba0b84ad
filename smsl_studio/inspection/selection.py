"""Selection: the remarks of a rule that are listed as findings, and the number of the others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.inspection.rules.finding import (
    LISTED,
    LISTED_IN_ALL,
    Finding,
    Remark,
    Severity,
    Spot,
)


def listed(blueprint: Blueprint, remarks: Iterable[Remark]) -> Iterator[Finding]:
    """Yield the findings of one rule, at most ``LISTED`` places of each SB and at most
    ``LISTED_IN_ALL`` places together.

    The gravest remarks are listed first, so that many notes never hide an error. The last finding
    says how many places are not listed.
    """
    shelves = {severity: _Shelf() for severity in Severity}
    for remark in remarks:
        shelves[remark.severity].put(remark)
    room = LISTED_IN_ALL
    rooms: dict[str, int] = {}
    chosen: list[tuple[Remark, int]] = []
    for shelf in shelves.values():
        for remark in shelf.kept:
            branch = remark.address.branch
            own = rooms.get(branch, LISTED)
            places = min(1 + len(remark.others), room, own)
            if places:
                room, rooms[branch] = room - places, own - places
                chosen.append((remark, places - 1))
    yield from _findings(blueprint, chosen, shelves.values())


class _Shelf:
    """The remarks of one severity, and the number of their places in each SB.

    A remark beyond the limits is counted but not kept.
    """

    def __init__(self) -> None:
        self.kept: list[Remark] = []
        self.count: dict[str, int] = {}

    def put(self, remark: Remark) -> None:
        """Count a remark, and keep it if the limits leave room to list it."""
        branch = remark.address.branch
        before = self.count.get(branch, 0)
        self.count[branch] = before + 1 + len(remark.others)
        if before < LISTED and len(self.kept) < LISTED_IN_ALL:
            self.kept.append(remark)


def _findings(
    blueprint: Blueprint, chosen: list[tuple[Remark, int]], shelves: Iterable[_Shelf]
) -> Iterator[Finding]:
    """Make findings of the chosen remarks. The number beside a remark is the number of further
    places that are listed."""
    left: dict[str, int] = {}
    for shelf in shelves:
        for branch, count in shelf.count.items():
            left[branch] = left.get(branch, 0) + count
    for remark, _ in chosen:
        left[remark.address.branch] -= 1 + len(remark.others)
    last = {remark.address.branch: number for number, (remark, _) in enumerate(chosen)}
    elsewhere = [count for branch, count in left.items() if count and branch not in last]
    for number, (remark, others) in enumerate(chosen):
        branch = remark.address.branch
        words = []
        if last[branch] == number and left[branch]:
            words.append(_unlisted(left[branch], branch))
        if elsewhere and number == len(chosen) - 1:
            words.append(_unlisted(sum(elsewhere), f"{len(elsewhere):,} other SBs"))
        finding = _finding(blueprint, remark, others)
        if words:
            finding = replace(finding, message=f"{finding.message} ({'; '.join(words)})")
        yield finding


def _unlisted(count: int, where: str) -> str:
    if count == 1:
        return f"1 more place in {where} is not listed"
    return f"{count:,} more places in {where} are not listed"


def _finding(blueprint: Blueprint, remark: Remark, others: int) -> Finding:
    """Make a finding of a remark: with its place, its remedy and ``others`` further places."""
    address, spot = remark.address, remark.spot
    if spot is None:
        place = blueprint.place(address, *remark.below)
    else:
        place = spot if isinstance(spot, Place) else spot[0].place(spot[1])
    spots = tuple(
        Spot(address, one) if isinstance(one, Place) else Spot(one, blueprint.place(one))
        for one in remark.others[:others]
    )
    advice, fix = remark.remedy() if remark.remedy else (remark.advice, remark.fix)
    more = len(remark.others) - others
    said = (remark.rule, remark.severity, address, place, remark.message, advice)
    return Finding(*said, fix, spots, more)
