"""Quick fixes of faults and findings, each one step."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.base.theme import DARK
from smsl_studio.studio.document.broken import read_text
from smsl_studio.studio.document.session import Broken, Session
from tests.studio.features.draw.source.conftest import CTRL, HFSM, Writer, read

At = Callable[..., Writer]
SAMPLES = Path(__file__).parents[5] / "samples"


def menu() -> QMenu:
    """The menu that is open."""
    shown = QApplication.activePopupWidget()
    assert isinstance(shown, QMenu)
    return shown


def test_a_finding_is_fixed_from_its_line(at_text: At) -> None:
    writer = at_text((SAMPLES / "hanoi.json").read_text("utf-8"), "hanoi.json")
    writer.pane.set_findings(inspect(writer.session.blueprint))
    writer.go('"Op_1c": "State_bbb"')
    assert writer.pane.repairing.bulb.isVisible()
    writer.key(Qt.Key.Key_Period, CTRL)
    shown = menu()
    assert shown.actions()[0].text() == "Rename to Op_1b"
    shown.actions()[0].trigger()
    shown.close()
    assert '"Op_1b": "State_bbb"' in writer.text
    assert len(writer.words) == 1
    writer.key(Qt.Key.Key_Z, CTRL)
    assert '"Op_1c": "State_bbb"' in writer.text


def test_the_bulb_keeps_to_its_line_in_a_wider_and_a_larger_text(at_text: At) -> None:
    writer = at_text((SAMPLES / "hanoi.json").read_text("utf-8"), "hanoi.json")
    pane, bulb = writer.pane, writer.pane.repairing.bulb
    pane.set_findings(inspect(writer.session.blueprint))
    pane.resize(220, 600)
    writer.go('"Op_1c": "State_bbb"')
    row = pane.editor.cursorRect
    assert not row().top() <= bulb.geometry().center().y() <= row().bottom(), "no room behind it"
    pane.resize(700, 600)
    assert row().top() <= bulb.geometry().center().y() <= row().bottom()
    beside = bulb.x()
    none = QPoint()
    turn = QWheelEvent(
        QPointF(50, 50), QPointF(50, 50), none, QPoint(0, 120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.ControlModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(pane.editor.viewport(), turn)
    assert bulb.x() > beside
    assert row().top() <= bulb.geometry().center().y() <= row().bottom()


def test_a_broken_file_is_shown_with_its_faults_and_repaired_one_by_one(at_text: At) -> None:
    text = HFSM.replace('"State_1",', '"State_1"').replace('"State_1": {}', '"State_1" {}')
    former = read(HFSM)
    broken = read_text(former, "a.json", text)
    assert isinstance(broken, Broken)
    session = Session(former)
    recovered = form_named("json").recover(text, "a.json")
    session.open(read_blueprint(recovered), broken)
    writer = at_text(session=session)
    assert writer.text == text
    assert writer.pane.faults.said.text().startswith("2 faults: line 6")
    assert writer.pane.faults.said.text().endswith("the graph shows what could be read.")
    assert set(writer.pane.editor.gutter.marks) == {5, 7}
    for _ in range(2):
        assert session.broken is not None
        writer.pane.faults.fix_button.click()
    assert session.broken is None
    assert writer.text == HFSM
    assert len(writer.words) == 2
    writer.pane.set_tokens(DARK)


def test_what_is_active_is_lit(at_text: At) -> None:
    writer = at_text()
    state = next(iter(writer.session.blueprint["SB1"].states.values()))
    writer.pane.set_active([state.address])
    assert writer.pane.editor.gutter.active == {3, 4, 5, 6}


def test_marks_move_with_the_text_while_one_types(at_text: At) -> None:
    writer = at_text((SAMPLES / "hanoi.json").read_text("utf-8"), "hanoi.json")
    findings = inspect(writer.session.blueprint)
    writer.pane.set_findings(findings)
    marked = len(writer.pane.editor.extraSelections())
    writer.go('"Op_1c": "State_bbb"')
    writer.type("x")
    writer.pane.set_findings(findings)
    assert len(writer.pane.editor.extraSelections()) == marked
