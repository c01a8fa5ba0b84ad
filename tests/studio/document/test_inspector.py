"""The inspector: every change is inspected again, and only findings of the shown blueprint
count."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import pytest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding
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
