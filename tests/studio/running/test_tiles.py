"""The tiles of facts: what is lit, how they are arranged, and that nothing is too long for them."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import QRect
from pytestqt.qtbot import QtBot

from smsl_studio.front.views.fact_tiles import FactTile
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.running.tiles import HIGH, LOW, TilesView

LONG = "x" * 10_000


def tile(digit: int, value: str | None = "a", **said: str) -> FactTile:
    plain = {"name": f"Fact {digit}", "group": "", "meaning": "", "words": "", "target": "",
             "quality": "agrees"} | said  # fmt: skip
    return FactTile(("SB1", digit), value=value, values=("a", "b", "c"), **plain)


@pytest.fixture
def view(qtbot: QtBot) -> TilesView:
    made = TilesView(LIGHT)
    qtbot.addWidget(made)
    made.resize(800, 220)
    made.show()
    return made


def _places(view: TilesView) -> list[QRect]:
    return [view.visualRect(view.tiles.index(at)) for at in range(view.tiles.rowCount())]


def test_a_tile_is_lit_when_its_value_has_changed_and_only_then(
    view: TilesView, qtbot: QtBot
) -> None:
    view.show_tiles((tile(0), tile(1)))
    assert view.lit == frozenset()
    view.show_tiles((tile(0, target="b", quality="transit"), tile(1)))
    assert view.lit == frozenset()
    view.show_tiles((tile(0, "b"), tile(1)))
    assert view.lit == {("SB1", 0)}
    view.show_tiles((tile(0, "b"), tile(1, None, quality="unknown")))
    assert view.lit == {("SB1", 1)}
    qtbot.waitUntil(lambda: view.lit == frozenset())


def test_tiles_fill_the_width_and_get_low_where_they_are_many(view: TilesView) -> None:
    view.show_tiles(tuple(map(tile, range(3))))
    assert {place.height() for place in _places(view)} == {HIGH}
    assert len({place.left() for place in _places(view)}) == 3
    view.show_tiles(tuple(map(tile, range(27))))
    assert {place.height() for place in _places(view)} == {LOW}
    places = _places(view)
    assert max(place.right() for place in places) <= view.viewport().width()
    assert len({place.left() for place in places}) == 4
    assert all(not a.intersects(b) for a, b in pairwise(places))


def test_a_tile_that_moves_out_of_view_comes_into_view(view: TilesView) -> None:
    tiles = tuple(map(tile, range(40)))
    view.show_tiles(tiles)
    view.show_tiles((*tiles[:39], tile(39, target="b", quality="transit")))
    assert view.viewport().rect().contains(_places(view)[39].center())
    view.show_tiles((*tiles[:39], tile(39, "b")))
    view.show_tiles((tile(0, target="c", quality="transit"), *tiles[1:39], tile(39, "b")))
    assert view.viewport().rect().contains(_places(view)[0].center())


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("quality", ["agrees", "differs", "unknown", "transit", "believed"])
def test_every_kind_is_painted_apart_from_the_others(
    view: TilesView, quality: str, tokens: object
) -> None:
    view.set_tokens(tokens)  # type: ignore[arg-type]
    view.show_tiles((tile(0), tile(1)))
    plain = view.grab().toImage()
    value = None if quality == "unknown" else "a"
    target = "b" if quality == "transit" else ""
    view.show_tiles((tile(0), tile(1, value, quality=quality, target=target)))
    assert (view.grab().toImage() == plain) is (quality in ("agrees", "believed"))


def test_the_token_moves_with_the_share_of_the_operation(view: TilesView) -> None:
    view.show_tiles((tile(0, target="c", quality="transit"),))
    seen = []
    for share in (0.0, 0.5, 1.0):
        view.show_share(share)
        seen.append(view.grab().toImage())
    assert seen[0] != seen[1] != seen[2]


def test_long_names_are_cut_and_told_in_part(view: TilesView) -> None:
    long = tile(0, name=LONG, meaning=LONG, words=LONG)
    view.show_tiles(
        (long, FactTile(("SB1", 1), LONG, LONG, LONG, LONG, (LONG, "a"), "", "", "agrees"))
    )
    view.grab()
    assert max(place.right() for place in _places(view)) <= view.viewport().width()
    told = str(view.tiles.index(0).data())
    assert len(told) < 5_000
