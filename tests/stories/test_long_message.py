"""A message in the status line that is too long ends in an ellipsis, and the tooltip has all."""

from __future__ import annotations

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

LONG = "Nothing else was changed, because " + "the name of this State Branch is long, " * 8


def test_a_long_message_is_shortened_and_the_tooltip_has_all(sit: Sit) -> None:
    window = sit(SAMPLES / "hfsm.json", (900, 600)).window
    line = window.status_line
    line.showMessage("Saved", 0)
    assert (line.shown_message, line.toolTip()) == ("Saved", "")
    line.showMessage(LONG, 0)
    assert line.shown_message.endswith("…")
    assert "the name of this State Branch" in line.toolTip()
    assert line.toolTip().count("is long") == 8, "all of it"
    line.showMessage("", 0)
    assert (line.shown_message, line.toolTip()) == ("", "")
