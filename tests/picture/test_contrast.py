"""Contrast: every pair of colours can be told apart, and the page has the measured table."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.picture.contrast import MORE, PAIRS, TEXT, THEMES, contrast, least, measured, table

PAGE = Path(__file__).parents[2] / "docs" / "contrast.md"


def test_the_ratio_is_that_of_the_standard() -> None:
    assert contrast("#000000", "#FFFFFF") == contrast("#FFFFFF", "#000000") == pytest.approx(21.0)
    assert contrast("#123456", "#123456") == 1.0
    # The grey that WCAG's own pages use as the last one that is enough on white.
    assert contrast("#767676", "#FFFFFF") == pytest.approx(4.54, abs=0.005)
    assert contrast("#777777", "#FFFFFF") < TEXT


@pytest.mark.parametrize("theme", THEMES)
def test_every_pair_has_its_contrast(theme: str) -> None:
    assert [pair for pair in PAIRS if measured(pair, theme) < least(pair, theme)] == []


def test_the_third_theme_asks_more_of_text_and_its_lines_are_the_clearest() -> None:
    for pair in PAIRS:
        if "stop" in pair:
            continue
        if pair.least == TEXT:
            assert least(pair, "contrast") == MORE
        else:
            others = [measured(pair, theme) for theme in ("light", "dark")]
            assert measured(pair, "contrast") > max(others)


def test_every_colour_is_in_a_pair_or_is_only_a_rule() -> None:
    used = {name for pair in PAIRS for name in (pair.ink, pair.ground)}
    only_rules = {"dot", "line", "line2", "accl", "dim"}
    assert {*THEMES["light"]} - used == only_rules


def test_the_page_has_the_table() -> None:
    """Where this fails, the rows that are missing are put into the page."""
    page = PAGE.read_text("utf-8").splitlines()
    assert [row for row in table() if row not in page] == []
    assert sum(row.startswith("| ") for row in page) == len(table()) - 1
