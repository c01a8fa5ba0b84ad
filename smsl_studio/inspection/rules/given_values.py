"""The fix for states whose names carry no facts: it gives them fact values."""

from __future__ import annotations

from itertools import count, islice, product

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.plain_words import Facts, carried
from smsl_studio.inspection.rules.finding import Fix, edit

MOST = 64
"""The largest number of states that get values by one fix."""

_SHOWN, _TRIES = 2, 4096


def values_fix(branch: StateBranch) -> Fix | None:
    """Return a fix that gives values to the states whose names carry no facts, or None.

    No other state has the same values. The words of the fix list them. The result is None if there
    is no such state, if there are more than ``MOST``, or if no free values are left.
    """
    if branch.shape.width == 0 and not branch.shape.opaque:
        return None
    others = carried(branch)
    needing = [state for state in branch.table if state not in others]
    if not needing or len(needing) > MOST:
        return None
    given = dict(zip(needing, islice(_free(branch, others, len(needing)), MOST), strict=False))
    if len(given) < len(needing):
        return None
    told = [f"{state} {' '.join(values)}" for state, values in given.items()]
    more = f" and {len(told) - _SHOWN} more" if len(told) > _SHOWN else ""
    words = f"Give values: {', '.join(told[:_SHOWN])}{more}"
    return Fix(words, edit("give_values", branch=branch.name, given=given))


def _free(branch: StateBranch, others: Facts, needed: int) -> list[tuple[str, ...]]:
    """Return combinations of values that no state with facts in its name has."""
    columns = [set(column) for column in zip(*others.values(), strict=True)]
    if not columns:
        said = max((*branch.notes.facts, *branch.subs, -1)) + 1
        said = max(said, branch.header.num_facts or 0)
        columns = [set() for _ in range(said)]
        bits = next(bits for bits in count(1) if 2**bits >= needed)
        columns += [set() for _ in range(bits - said)]
    for column in columns:
        if column <= {"0", "1"}:
            column |= {"0", "1"}
    taken = set(others.values())
    tried = islice(product(*map(sorted, columns)), _TRIES)
    return [values for values in tried if values not in taken]
