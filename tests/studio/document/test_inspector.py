"""The inspector: every change is inspected again, and only findings of the shown blueprint
count."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from threading import Event

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.claim_rows import ClaimAnswers, answered
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.library.loaded import Loaded
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.stop import Stopped, heed
from smsl_studio.studio.document import inspector as room
from smsl_studio.studio.document.files.fresh import empty_blueprint
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session


def add(number: int, blueprint: Blueprint) -> Blueprint:
    return editing.add_state(blueprint, "SB1", f"State{number}")


@pytest.fixture
def session(qtbot: QtBot) -> Session:
    return Session(empty_blueprint())


@pytest.fixture
def inspector(session: Session) -> Iterator[Inspector]:
    made = Inspector(session)
    yield made
    made.stop()


def watched(monkeypatch: pytest.MonkeyPatch) -> list[Blueprint]:
    """Every blueprint that is inspected from now on; nothing is found in any."""
    seen: list[Blueprint] = []

    def inspected(blueprint: Blueprint) -> tuple[Finding, ...]:
        seen.append(blueprint)
        return ()

    monkeypatch.setattr(room, "inspect", inspected)
    return seen


def test_every_change_is_inspected(session: Session, inspector: Inspector, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: inspector.current)
    assert inspector.findings == inspect(session.blueprint)
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State0"))
    assert not inspector.current, "what was found before is not what is shown now"
    qtbot.waitUntil(lambda: inspector.current)
    assert inspector.findings == inspect(session.blueprint)


def test_many_edits_are_inspected_once(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    qtbot.waitUntil(lambda: inspector.current)
    seen = watched(monkeypatch)
    for number in range(9):
        session.edit("Add", partial(add, number))
    qtbot.waitUntil(lambda: inspector.current)
    assert seen == [session.blueprint]


def test_a_fault_in_a_rule_crashes_where_the_work_is_kept(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    qtbot.waitUntil(lambda: inspector.current)

    def fail(_: object) -> None:
        raise RuntimeError("a rule of ours")

    monkeypatch.setattr(room, "inspect", fail)
    with qtbot.captureExceptions() as caught:
        session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State0"))
        qtbot.waitUntil(lambda: bool(caught))
    assert str(caught[0][1]) == "a rule of ours"
    assert not inspector.current


def test_a_save_while_it_inspects_loses_nothing(
    session: Session, inspector: Inspector, qtbot: QtBot
) -> None:
    qtbot.waitUntil(lambda: inspector.current)
    inspector.current = False
    inspector._inspect()
    session.saved(replace(session.blueprint))
    qtbot.waitUntil(lambda: inspector.current)


def test_undo_and_redo_bring_the_findings_back_without_an_inspection(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    qtbot.waitUntil(lambda: inspector.current)
    before = inspector.findings
    session.edit("Add", partial(add, 0))
    qtbot.waitUntil(lambda: inspector.current)
    after = inspector.findings
    assert after != before
    seen: list[Blueprint] = []
    monkeypatch.setattr(room, "inspect", seen.append)
    for _ in range(2):
        session.history.undo()
        assert not inspector.current
        qtbot.waitUntil(lambda: inspector.current)
        assert inspector.findings == before
        session.history.redo()
        qtbot.waitUntil(lambda: inspector.current)
        assert inspector.findings == after
    assert seen == []


def test_only_the_findings_of_the_last_blueprints_are_kept(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(room, "KEPT", 2)
    for number in range(4):
        session.edit("Add", partial(add, number))
        qtbot.waitUntil(lambda: inspector.current)
    seen = watched(monkeypatch)
    for _ in range(3):
        session.history.undo()
        qtbot.waitUntil(lambda: inspector.current)
    assert len(seen) == 2


BRANCH = {
    "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
    "State_00": {"on": "State_10", "skip": "State_01"},
    "State_10": {"end": "State_11"},
    "State_01": {"end": "State_11"},
    "State_11": {"again": "State_00"},
}
HAZARD = {"name": "Blind cut", "facts": {"SB/0": "0", "SB/1": "1"}}
SKIP = Address("SB", "State_00", "skip")


def guarded() -> Blueprint:
    """A blueprint with a hazard that its operation ``skip`` leads to."""
    text = json.dumps({"_hazards": [HAZARD], "SB": BRANCH}, indent=1)
    return read_blueprint(parse_json(text, "guarded.json"))


def without_skip(blueprint: Blueprint) -> Blueprint:
    return editing.delete(blueprint, [SKIP])


def test_hazards_are_answered_after_every_change(
    session: Session, inspector: Inspector, qtbot: QtBot
) -> None:
    session.open(guarded())
    assert inspector.proof is None
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert inspector.proof is not None
    assert [one.verdict for one in inspector.proof.verdicts] == ["fails"]
    (finding,) = [one for one in inspector.findings if one.rule == "R19"]
    assert str(finding.address) == "_hazards/Blind cut"
    assert list(inspector.findings) == sorted(inspector.findings, key=lambda one: one.place)

    session.edit("Delete", without_skip)
    assert inspector.proof is None, "what was shown before is not shown now"
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert [one.verdict for one in inspector.proof.verdicts] == ["holds"]
    assert "R19" not in {one.rule for one in inspector.findings}

    session.history.undo()
    assert inspector.proof is None
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert [one.verdict for one in inspector.proof.verdicts] == ["fails"]


class Slow:
    """An answer that takes until ``ends`` is set, and heeds that it is called off."""

    def __init__(self) -> None:
        self.begun, self.ends, self.called_off = Event(), Event(), Event()

    def __call__(self, blueprint: Blueprint, tell: Callable[[int], object]) -> ClaimAnswers:
        self.begun.set()
        try:
            while not self.ends.wait(0.01):
                heed()
        except Stopped:
            self.called_off.set()
            raise
        return answered(blueprint, 1000)


def test_what_must_hold_is_listed_before_it_is_answered(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = Slow()
    monkeypatch.setattr(room, "_answer", slow)
    with qtbot.waitSignal(inspector.listed):
        session.open(guarded())
    assert [(one.name, one.verdict) for one in inspector.unanswered] == [("Blind cut", "unknown")]
    slow.ends.set()
    qtbot.waitUntil(lambda: inspector.proof is not None)
    listed: list[object] = []
    inspector.listed.connect(lambda: listed.append(inspector.unanswered))
    session.edit("Delete skip", without_skip)
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert listed == [], "after an edit the rows stay where they are"


def test_the_rules_do_not_wait_for_slow_properties(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = Slow()
    monkeypatch.setattr(room, "_answer", slow)
    session.open(guarded())
    qtbot.waitUntil(lambda: inspector.current)
    assert inspector.proving
    assert inspector.proof is None
    assert inspector.findings == inspect(session.blueprint)
    slow.ends.set()
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert not inspector.proving
    assert len(inspector.findings) > len(inspect(session.blueprint))


def test_an_edit_calls_the_search_off(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = Slow()
    monkeypatch.setattr(room, "_answer", slow)
    session.open(guarded())
    qtbot.waitUntil(slow.begun.is_set)
    session.edit("Delete", without_skip)
    qtbot.waitUntil(slow.called_off.is_set)
    slow.ends.set()
    qtbot.waitUntil(lambda: inspector.proof is not None)
    assert inspector.proof is not None
    assert [one.verdict for one in inspector.proof.verdicts] == ["holds"]


def test_a_person_stops_the_search_and_lets_it_begin_again(
    session: Session, inspector: Inspector, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = Slow()
    monkeypatch.setattr(room, "_answer", slow)
    session.open(guarded())
    qtbot.waitUntil(slow.begun.is_set)
    inspector.stop_looking()
    qtbot.waitUntil(slow.called_off.is_set)
    assert inspector.stopped
    assert inspector.current
    assert inspector.proof is None
    slow.ends.set()
    inspector.look_again()
    assert not inspector.stopped
    qtbot.waitUntil(lambda: inspector.proof is not None)


def test_a_world_is_asked_too_until_another_file_is_opened(
    session: Session, inspector: Inspector, qtbot: QtBot
) -> None:
    note = {"cut": {"actor": "shared", "risk": "high"}}
    plain = {"SB": {"_operations": note, "S_0": {"cut": "S_1"}, "S_1": {"back": "S_0"}}}
    session.open(read_blueprint(parse_json(json.dumps(plain), "file.json")))
    qtbot.waitUntil(lambda: inspector.current)
    assert "R26" not in {one.rule for one in inspector.findings}
    inspector.look_in("table", None)
    assert not inspector.current
    qtbot.waitUntil(lambda: inspector.current)
    assert "R26" in {one.rule for one in inspector.findings}
    inspector.look_in("table", None)
    assert inspector.current, "nothing has changed"
    inspector.look_in("nowhere", Loaded(()))
    qtbot.waitUntil(lambda: inspector.current)
    assert "R26" not in {one.rule for one in inspector.findings}, "a world that is gone"
    inspector.look_in("table", None)
    session.open(read_blueprint(parse_json(json.dumps(plain), "other.json")))
    qtbot.waitUntil(lambda: inspector.current)
    assert "R26" not in {one.rule for one in inspector.findings}
