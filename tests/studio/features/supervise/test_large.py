"""The large layout of Supervise: what it says, and that it says less where it has less room."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtGui import QFontMetricsF
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.partial import partial_view
from smsl_studio.studio.base.theme import LIGHT, text_font
from smsl_studio.studio.features.supervise.card import CardForecast
from smsl_studio.studio.features.supervise.large_view import PLAIN, ROW, LargeView
from smsl_studio.studio.features.supervise.large_words import (
    BAD,
    GOOD,
    LargeFact,
    LargeRun,
    LargeWords,
    large_words,
)
from tests.front.views.statuses import sample, status

SAMPLE = sample("hanoi-2.json")
EDGE = Address("SB1", "State_ba", "Op_2c")
HERE = status({"SB1": "State_ba"}, route=(EDGE,))
VIEW = partial_view(SAMPLE, HERE, "SB1")


def test_it_says_where_the_run_stands_and_what_comes_next() -> None:
    told = CardForecast(EDGE, agrees=False, words="Fact 2 will be b")
    run = LargeRun(SAMPLE, HERE, "paused")
    words = large_words(run, VIEW, EDGE, told)
    assert (words.phase, words.state, words.ahead) == ("Paused", "State_ba", "Op_2c")
    assert words.target == "to State_bc"
    assert words.forecast == ("Forecast differs: fact 2 will be b", BAD)
    assert [one.name for one in words.facts] == ["Fact 1", "Fact 2"]
    assert "State_ba" in words.said
    other = CardForecast(Address("SB1", "State_ba", "Op_1a"), agrees=True)
    assert large_words(run, VIEW, EDGE, other).forecast[0] == ""
    held = replace(HERE, sentence="nothing leads to the goal")
    no_route = LargeRun(SAMPLE, held, "no_route")
    assert large_words(no_route, VIEW, None, None).question == held.sentence
    ended = LargeRun(SAMPLE, HERE, "held", over=True, sentence="it ended")
    over = large_words(ended, VIEW, EDGE, told)
    assert (over.question, over.ahead) == ("It ended.", "")
    asked = replace(run, asked="Veto Op_2c once?")
    assert large_words(asked, VIEW, EDGE, None).question == "Veto Op_2c once?"
    assert "F5" in large_words(LargeRun(None, None, ""), None, None, None).question


def test_a_fact_that_does_not_agree_is_never_left_out_for_one_that_does(qtbot: QtBot) -> None:
    view = LargeView(LIGHT)
    qtbot.addWidget(view)
    facts = tuple(LargeFact(f"Fact {n}", "1", GOOD, "agrees") for n in range(8))
    odd = LargeFact("Clamp", "?", BAD, "differs")
    view.show_words(LargeWords("Paused", "quiet", facts=(*facts, odd)))
    assert view.shown_facts(9 * ROW) == (*facts, odd)
    assert view.shown_facts(4 * ROW) == (facts[0], facts[1], odd), "the last row says how many more"
    assert view.shown_facts(0.0) == ()
    usual, large = (QFontMetricsF(text_font(size)) for size in (13, PLAIN))
    assert large.height() >= 1.9 * usual.height()
