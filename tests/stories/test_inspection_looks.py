"""The page Inspection while it looks: rows without verdicts, how far it is, Stop looking."""

from __future__ import annotations

import json
from pathlib import Path
from threading import Event
from typing import Any

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.proof import Proof, proof_in
from smsl_studio.inspection.proof.prove import Scope
from smsl_studio.stop import heed
from smsl_studio.studio.document import inspector
from tests.stories.conftest import Sit
from tests.stories.test_inspection_page import (
    BOTH,
    DRILL,
    HAZARD,
    REG,
    answered,
    cells,
    choose,
    page,
)

Key = Qt.Key


def test_while_the_first_answers_are_looked_for_the_rows_are_there(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended, free, rules = Event(), Event(), Event()
    inspected = inspector._inspected

    def after_the_rules(*asked: Any) -> object:
        """Rules that last until ``rules`` is set."""
        rules.wait(60)
        return inspected(*asked)

    def slowly(blueprint: Blueprint, scope: Scope) -> Proof:
        """A search that has found 12,000 configurations and lasts."""
        scope.tell(12_000)
        try:
            while not free.is_set():
                heed()
        finally:
            ended.set()
        return proof_in(blueprint, scope)

    monkeypatch.setattr(inspector, "_inspected", after_the_rules)
    monkeypatch.setattr("smsl_studio.front.claim_rows.proof_in", slowly)
    file = tmp_path / "drill.json"
    values = {"_hazards": [HAZARD], "_properties": [BOTH], "DRILL": DRILL, "REG": REG}
    file.write_text(json.dumps(values, indent=1))
    person = sit(file)
    person.ctrl(Key.Key_I)
    at = page(person)
    assert not at.empty.title.isVisible(), "something is written, so the page does not deny it"
    assert at.said.text() == "Not answered yet."
    rules.set()
    person.until(lambda: at.sum.text() == "Looking, 12,000 so far")
    assert [one.name for one in at.table.claims.rows] == ["Blind", "Both"]
    assert cells(person, "Blind") == [
        "Unknown", "Blind", "hazard", "Never: drill running while not registered",
        "Looking, 12,000 so far", "error",
    ]  # fmt: skip
    choose(person, "Both")
    assert at.said.text().endswith("Looking, 12,000 so far.")
    assert at.again.text() == "Stop looking"
    person.click(at.again)
    person.until(ended.is_set)
    assert cells(person, "Both")[4] == "Stopped looking"
    free.set()
    person.click(at.again)
    answered(person)
    assert cells(person, "Blind")[0] == "Fails"
    assert at.table.chosen is not None
    assert at.table.chosen.name == "Both", "the choice stays"
