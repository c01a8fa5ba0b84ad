"""R09: names that look alike. Names that differ in the same characters share one finding."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.rules.finding import Remark, Severity

_CASE, _LOOKS = "case", "characters that look alike"


def r09_look_alikes(blueprint: Blueprint) -> Iterator[Remark]:
    """R09: names that differ only by case or by characters that look alike.

    States and operations may differ by the case of a fact value: a chess board has blocks ``a``
    and ``A``, and ``move-a-to-A`` is another operation than ``move-A-to-a``.
    """
    yield from _alike(((name, Address(name)) for name in blueprint.branches), "SB", _never)
    for branch in blueprint:
        values = _Values(branch)
        states = ((name, Address(branch.name, name)) for name in branch.table)
        yield from _alike(states, "state", values.part_states)
        first: dict[str, Address] = {}
        for state, operations in branch.table.items():
            for name in operations:
                if name not in first:
                    first[name] = Address(branch.name, state, name)
        yield from _alike(first.items(), "operation", values.part)


class _Cause:
    """Names that differ from others in the same characters."""

    def __init__(self, name: str, other: str) -> None:
        self.name, self.other = name, other
        self.places: list[Address] = []


def _alike(
    names: Iterable[tuple[str, Address]], what: str, meant: Callable[[str, str], bool]
) -> Iterator[Remark]:
    """Report the look-alikes among some names. ``meant`` decides whether two names may differ by
    case only."""
    by_case: dict[str, str] = {}
    by_look: dict[str, str] = {}
    causes: dict[tuple[str, object], _Cause] = {}
    for name, address in names:
        case = by_case.setdefault(name.casefold(), name)
        look = by_look.setdefault(_look(name), name)
        other, by = case, _CASE
        if case == name or meant(name, case):
            other, by = look, _LOOKS
        if other == name:
            continue
        cause = causes.setdefault((by, _difference(name, other)), _Cause(name, other))
        cause.places.append(address)
    for (by, _), cause in causes.items():
        yield Remark(
            "R09",
            Severity.WARNING,
            cause.places[0],
            f"the {what} {cause.name} differs from {cause.other} only by {by}",
            "give one of them another name",
            others=cause.places[1:],
        )


def _difference(name: str, other: str) -> object:
    """A key for the characters in which two names differ: equal for equal differences."""
    if len(name) != len(other):
        return len(name) - len(other)
    return frozenset(frozenset(pair) for pair in zip(name, other, strict=True) if len({*pair}) > 1)


def _never(name: str, other: str) -> bool:
    return False


_RUNS = re.compile(r"[^\W_]+|[\W_]+")
_PIECES = re.compile(r"[^\W\d_]+|\d+|[\W_]+")


class _Values:
    """The fact values of an SB, to find them in names."""

    def __init__(self, branch: StateBranch) -> None:
        self._branch = branch
        self._known: frozenset[str] | None = None

    def part_states(self, name: str, other: str) -> bool:
        """Whether two states differ only in the facts that their names carry."""
        shape = self._branch.shape
        if shape.width and self._of_branch:
            one, two = fact_string(name, shape.written), fact_string(other, shape.written)
            return name.removesuffix(one) == other.removesuffix(two)
        return self.part(name, other)

    def part(self, name: str, other: str) -> bool:
        """Whether two names differ only in words that are fact values of the SB."""
        return self._differ(_RUNS, name, other) or self._differ(_PIECES, name, other)

    def _differ(self, words: re.Pattern[str], name: str, other: str) -> bool:
        ours, theirs = words.findall(name), words.findall(other)
        if len(ours) != len(theirs):
            return False
        pairs = ((a, b) for a, b in zip(ours, theirs, strict=True) if a != b)
        return all(a in self._of_branch and b in self._of_branch for a, b in pairs)

    @property
    def _of_branch(self) -> frozenset[str]:
        if self._known is None:
            branch = self._branch
            digits = branch.alphabet if _carries_facts(branch) else ()
            self._known = frozenset(value for values in digits for value in values)
        return self._known


def _carries_facts(branch: StateBranch) -> bool:
    """Whether the state names of an SB carry facts. Names of equal length alone do not show it."""
    shape = branch.shape
    if shape.opaque or not shape.width or shape.written is not None:
        return not shape.opaque
    return all(fact_string(name, None) != name for name in branch.table)


# Each text has a Latin letter first, then digits, Cyrillic and Greek letters that look like it.
_SAME = (
    *("O0ОΟ", "oоο", "l1IІΙ|", "iі", "aа", "cс", "eе", "pр", "xх", "yу", "sѕ", "jј", "vν"),
    *("AАΑ", "BВΒ", "CС", "EЕΕ", "HНΗ", "KКΚ", "MМΜ", "NΝ", "PРΡ", "TТΤ", "XХΧ", "YУΥ", "ZΖ"),
)
_LOOK = {ord(char): same[0] for same in _SAME for char in same}


def _look(name: str) -> str:
    """Return the name with each character replaced by the first of its look-alikes."""
    return unicodedata.normalize("NFKC", name).translate(_LOOK)
