"""The rows of the list “Merged by themselves”."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.merge.sides import ALIKE, MINE, THEIRS, MergedGroup, MergeSides
from smsl_studio.studio.base.rows import ListRow
from smsl_studio.studio.base.words import counted

SECTIONS = {MINE: "Mine", THEIRS: "Theirs", ALIKE: "Both alike"}
ICONS = {"+": "plus", "-": "minus", "~": "pencil"}
NAMED = 3
"""A row names so many elements."""
UNKNOWN = "Not known: the file tells the conflicts alone"
BY_LINES = "Lines outside the markers: git had merged them already"
NO_BASE = "No base: every difference is a conflict"


def merged_rows(groups: Sequence[MergedGroup], sides: MergeSides) -> list[ListRow]:
    """One row for each kind of change of a side, with the addresses that a click selects."""
    before = [ListRow(BY_LINES, kind="section")] if sides.by_lines else []
    if not groups:
        words = "Nothing else changed" if sides.known else UNKNOWN
        if sides.base is None:
            words = NO_BASE
        elif sides.by_lines:
            return before
        return [ListRow(words, kind="section"), *before]
    rows: list[ListRow] = []
    side = ""
    for group in groups:
        if group.side != side:
            side = group.side
            number = sum(len(one.changes) for one in groups if one.side == side)
            rows.append(ListRow(f"{SECTIONS[side]}, {counted(number, 'change')}", kind="section"))
        addresses = dict.fromkeys(one.address for one in group.changes if one.address)
        names = [one.path[-1] for one in addresses]
        more = len(names) - NAMED
        words = ", ".join(names[:NAMED]) + (f" and {more:,} more" if more > 0 else "")
        rows.append(
            ListRow(
                words or "the file",
                tuple(addresses),
                ICONS[group.sign],
                right=f"{len(group.changes):,}",
                accent=side != THEIRS,
                tip="\n".join(one.words for one in group.changes[:20]),
            )
        )
    return [*rows, *before]
