"""The status line in a narrow window: what stands there can be read, the rest is in its tooltip."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.shell.frame.status_line import ENDING, READABLE, StatusLine
from tests.stories.at_canvas import sample

LEFT = ("World table", "Seed 0", "Simulated 12.5 s", "Operations shown at 1 ×",
        "Frozen copy, drawing unchanged", "State_ab holds, and Op_1b is next.")  # fmt: skip
RIGHT = ("Alive, 0.1 ms", "Recording", "Simulation only")


@pytest.fixture
def line(qtbot: QtBot) -> Callable[[int], StatusLine]:
    """A line in a window, which may be narrower than all its words."""
    window = QWidget()
    qtbot.addWidget(window)

    def make(width: int) -> StatusLine:
        made = StatusLine()
        made.setParent(window)
        made.resize(width, made.height())
        window.resize(2400, 100)
        window.show()
        return made

    return make


def shown(made: StatusLine) -> list[str]:
    parts = [*made.counts, *made.run, made.form, made.place, *made.run_right]
    return [part.text() for part in parts if part.isVisible()]


@pytest.mark.parametrize("width", [640, 900, 2400])
def test_a_run_keeps_its_sentence_and_what_is_left_out_is_in_the_tooltip(
    line: Callable[[int], StatusLine], width: int
) -> None:
    made = line(width)
    made.show_mode("run")
    made.show_run((LEFT, RIGHT))
    seen = shown(made)
    assert LEFT[-1] in seen
    assert made.ending.text() == ENDING
    out = [words for words in (*LEFT, *RIGHT) if words not in seen]
    assert bool(out) is (width < 2400)
    assert all(words in made.toolTip() for words in out)
    # More room brings them back.
    made.resize(2400, made.height())
    assert set(shown(made)) == {*LEFT, *RIGHT}
    assert made.toolTip() == ""


def test_a_drawing_keeps_its_findings(line: Callable[[int], StatusLine]) -> None:
    made, blueprint = line(420), sample("hfsm.json")
    made.show_blueprint(blueprint)
    made.show_findings("1 error, 2 warnings, 3 notes")
    made.show_place(blueprint, Address("SB1"))
    assert "1 error, 2 warnings, 3 notes" in shown(made)
    assert "JSON, UTF-8" not in shown(made)
    assert "JSON, UTF-8" in made.toolTip()


@pytest.mark.parametrize("sentence", [LEFT[-1], "The run waits for an answer of the surgeon. " * 3])
def test_short_words_are_whole_or_left_out(
    line: Callable[[int], StatusLine], qtbot: QtBot, sentence: str
) -> None:
    made = line(2400)
    made.show_mode("run")
    made.show_run(((*LEFT[:-1], sentence), RIGHT))
    for width in range(640, 1600, 48):
        made.resize(width, made.height())
        qtbot.waitUntil(lambda: not cut(made))
        assert made.ending.geometry().right() < width


def cut(made: StatusLine) -> list[str]:
    """The short words that are not whole."""
    parts = [part for part in (*made.run, *made.run_right) if part.isVisible()]
    return [one.text() for one in parts if one.width() < min(one.sizeHint().width(), READABLE)]
