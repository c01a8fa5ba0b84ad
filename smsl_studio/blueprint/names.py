"""New names for new elements, similar to the existing names."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from itertools import count, islice, product
from string import ascii_lowercase

from smsl_studio.blueprint.facts import fact_string, fact_strings
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import has_only_words

_TRIES = 4096
_LONGEST = 64
"""The largest number of facts in a name that is made here."""


def fresh_branch_name(blueprint: Blueprint) -> str:
    """Return the first free name among ``SB1``, ``SB2`` and so on."""
    return next(numbered("SB", blueprint.branches))


def fresh_state_name(branch: StateBranch) -> str:
    """Return a free name similar to the SB's states: their prefix with unused fact values.

    The first state of an SB is ``State0``, with NUM_FACTS digits.
    """
    if not branch.table:
        return "State" + "0" * min(branch.header.num_facts or 1, _LONGEST)
    return next(fresh_state_names(branch))


def fresh_state_names(branch: StateBranch) -> Iterator[str]:
    """Yield all free names of this form, for an SB with states.

    Names that show facts are free only if no state has their facts under whatever prefix: both
    would have the same short form.
    """
    shape = branch.shape
    if shape.opaque or shape.width == 0 or has_only_words(branch):
        yield from numbered("State", branch.table)
        return
    last = next(reversed(branch.table))
    prefix = last[: len(last) - len(fact_string(last, shape.written))]
    taken = {*fact_strings(branch.table, shape.written)}
    values = sorted({value for column in branch.alphabet for value in column})
    if set(values) <= {"0", "1"}:
        values = ["0", "1"]
    for digits in islice(product(values, repeat=shape.num_facts), _TRIES + len(branch.table)):
        facts = "".join(digits)
        if facts not in taken:
            yield prefix + facts
    # Every combination is taken. A new value of the last fact keeps the length of the names.
    for value in _more_values(shape.width, values):
        for digits in islice(product(values, repeat=shape.num_facts - 1), _TRIES):
            facts = "".join(digits) + value
            if facts not in taken:
                yield prefix + facts
    yield from numbered(prefix, branch.table)


def fact_choices(branch: StateBranch, digit: int) -> tuple[str, ...]:
    """Return the values that a digit can have in a new name: those in use and those in ``_facts``,
    and always both of 0 and 1.
    """
    values, note = set(branch.alphabet[digit]), branch.fact_note(digit)
    used = values if values - {"0", "1"} else {"0", "1"}
    named = {*note.values, *note.failure, note.on or ""} if note is not None else set()
    return tuple(sorted(used | {one for one in named if len(one) == branch.shape.width}))


def next_free_facts(branch: StateBranch, state: str) -> tuple[str, ...]:
    """Return the next values after those of a state that no state has, counted up from the last
    digit. Failure values are left out. Empty if the names of the SB do not show facts.
    """
    shape, facts = branch.shape, branch.facts(state)
    if shape.opaque or shape.width == 0:
        return ()
    taken = {branch.facts(name) for name in branch.table}
    wheels = [_wheel(branch, digit, value) for digit, value in enumerate(facts)]
    for values in islice(product(*wheels), _TRIES + len(taken)):
        if values not in taken:
            return values
    return shape.values(next(fresh_state_names(branch)))


def _wheel(branch: StateBranch, digit: int, value: str) -> list[str]:
    """The values of a digit in the order of counting up, from ``value`` on."""
    note = branch.fact_note(digit)
    failing = note.failure if note is not None else ()
    values = [one for one in fact_choices(branch, digit) if one == value or one not in failing]
    at = values.index(value)
    return values[at:] + values[:at]


def name_with_facts(branch: StateBranch, state: str, values: Iterable[str]) -> str:
    """Return the name of a state with other facts; the SB's names must show facts."""
    text = fact_string(state, branch.shape.written)
    return state[: len(state) - len(text)] + "".join(values)


def _more_values(width: int, values: list[str]) -> Iterator[str]:
    """Yield values of a fact of this width that do not occur yet."""
    numbers = (f"{number:0{width}}" for number in range(10 ** min(width, 3)))
    yield from (value for value in numbers if value not in values)
    letters = (letter * width for letter in ascii_lowercase)
    yield from (value for value in letters if value not in values)


def fresh_operation_name(branch: StateBranch, state: str) -> str:
    """Return a free name in ``state``: ``Operation`` with the state's facts, and a letter if
    necessary.
    """
    taken = branch.table.get(state, {})
    used = {name for operations in branch.table.values() for name in operations}
    prefix = "Op_" if used and all(name.startswith("Op_") for name in used) else "Operation"
    plain = prefix + fact_string(state, branch.header.num_facts)
    if plain not in taken and not any(name.startswith(plain) for name in taken):
        return plain
    for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ":
        if plain + letter not in taken:
            return plain + letter
    return next(numbered(plain, taken))


class FreeNames:
    """Free names, each similar to a wanted one. The count goes on where it ended, so many names of
    one kind are found quickly.
    """

    def __init__(self, taken: Iterable[str]) -> None:
        self.taken = set(taken)
        self._used: dict[tuple[str, int], tuple[int, int]] = {}
        """For a stem and a width, a range of numbers that are all taken: its first, and the one
        after it.
        """

    def take(self, name: str) -> str:
        """Return the name itself if it is free, else with the next free number, and take it."""
        free = name if name not in self.taken else self._numbered(name)
        self.taken.add(free)
        return free

    def _numbered(self, name: str) -> str:
        stem = name.rstrip("0123456789")
        width = len(name) - len(stem)
        number = 2
        if 0 < width < _LONGEST:
            number = int(name[len(stem) :]) + 1
        else:
            stem, width = name, 0
        begin, end = self._used.get((stem, width), (0, 0))
        first = begin if begin <= number <= end else number
        while (free := f"{stem}{number:0{width}}") in self.taken:
            number = end if begin <= number < end else number + 1
        self._used[stem, width] = first, number + 1
        return free


def numbered(prefix: str, taken: Container[str], first: int = 1) -> Iterator[str]:
    """Yield the prefix with every number that makes a free name."""
    return (f"{prefix}{n}" for n in count(first) if f"{prefix}{n}" not in taken)
