"""The lines of forms: typed text becomes a value, or a sentence that tells why not."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.lines.choice import ChoiceLine
from smsl_studio.studio.base.lines.line import ShownValue
from smsl_studio.studio.base.lines.text import ListLine, NumberBounds, NumberLine, number_text
from tests.counts import share_of

words = st.text(
    st.characters(exclude_categories=["Cs", "Cc", "Z"]) | st.sampled_from(' ,"'), min_size=1
).filter(lambda text: text == text.strip())


@settings(max_examples=share_of(60), deadline=None)
@given(st.lists(words, min_size=1, max_size=5, unique=True))
def test_a_list_is_read_as_it_is_shown(qapp: object, texts: list[str]) -> None:
    line = ListLine("Sensors", "")
    assert line.value_of(line.text_of(texts)) == texts


@settings(max_examples=share_of(60), deadline=None)
@given(st.floats(0, 1e12))
def test_a_number_is_read_as_it_is_shown(qapp: object, value: float) -> None:
    line = NumberLine("Cost", "", NumberBounds())
    assert line.value_of(number_text(value)) == value


def test_what_is_no_number_is_said_in_a_sentence(qtbot: QtBot) -> None:
    line = NumberLine("k", "", NumberBounds(1, whole=True))
    qtbot.addWidget(line)
    said = {}
    for text in ("x", "1.5", "0", "inf", "nan", "1e999", "9" * 400, "2"):
        line.show_values([ShownValue()])
        line.field.setText(text)
        line.field.editingFinished.emit()
        said[text] = line.refusal.text()
    assert all(said[text] for text in said if text != "2"), said
    assert said["2"] == ""
    assert all(len(sentence) < 120 for sentence in said.values())
    assert NumberBounds().sentence("inf") == "“inf” is too large. Write 1e+12 or less."
    assert "too large" in NumberBounds().sentence("2e12")


def test_values_that_differ_are_said_to_and_stay(qtbot: QtBot) -> None:
    line = ChoiceLine("Risk", "", (("Low", "low"), ("High", "high")))
    qtbot.addWidget(line)
    told: list[object] = []
    line.given.connect(told.append)
    line.show_values([ShownValue("low"), ShownValue("high")])
    assert line.field.currentText() == "Various"
    line.field.activated.emit(line.field.currentIndex())
    assert told == []
    line.show_values([ShownValue(None, "low", "all Op")])
    assert line.field.currentText() == "Low (all Op)"
