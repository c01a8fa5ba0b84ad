"""The sheets of a poster have the whole picture, overlap, and never leave their room."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.errors import UsageError
from smsl_studio.studio.features.export.poster import (
    FOOT,
    MOST_SHEETS,
    NATURAL,
    OVERLAP,
    on_one_sheet,
    poster,
)

ROOM = (538.0, 785.0)
SIDES = st.floats(100.0, 9_000.0)


@given(SIDES, SIDES, st.integers(1, 8))
def test_a_poster_has_all_of_the_picture(wide: float, high: float, across: int) -> None:
    try:
        rows = poster((wide, high), ROOM, across)
    except UsageError:
        assert high / wide * across**2 * ROOM[0] / ROOM[1] > MOST_SHEETS / 2
        return
    assert all(len(row) == across for row in rows)
    scale = rows[0][0].target[2] / rows[0][0].source[2]
    ends = [one.source[0] + one.source[2] for one in rows[0]]
    assert ends[-1] == pytest.approx(wide)
    assert rows[-1][0].source[1] + rows[-1][0].source[3] >= high - 1.5 / scale
    for row in rows:
        for one in row:
            assert one.target[2] <= ROOM[0] + 1e-6
            assert one.target[3] <= ROOM[1] - FOOT + 1e-6
            assert one.target[2] / one.source[2] == pytest.approx(scale)
            assert one.target[3] / one.source[3] == pytest.approx(scale)
    for left, right in zip(rows[0], rows[0][1:], strict=False):
        both = left.source[0] + left.source[2] - right.source[0]
        assert both * scale == pytest.approx(OVERLAP)
    words = {one.words for row in rows for one in row}
    assert len(words) == len(rows) * across


@given(SIDES, SIDES)
def test_one_sheet_has_it_in_the_middle(wide: float, high: float) -> None:
    ((one,),) = on_one_sheet((wide, high), ROOM)
    left, top, across, down = one.target
    assert one.source == (0.0, 0.0, wide, high)
    assert across <= ROOM[0] + 1e-6
    assert down <= ROOM[1] + 1e-6
    assert across / wide <= NATURAL + 1e-9
    assert left * 2 + across == pytest.approx(ROOM[0])
    assert top * 2 + down == pytest.approx(ROOM[1])


def test_too_many_sheets_are_refused() -> None:
    with pytest.raises(UsageError, match="sheets"):
        poster((100.0, 90_000.0), ROOM, 4)
