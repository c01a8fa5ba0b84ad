"""The badge of trust: it follows the record of the blueprint, and a click tells the reasons."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import add_state, delete, set_layout
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.features.approval import feature
from tests.approval import DOOR, written_policy
from tests.stories.conftest import Sit
from tests.stories.person import Person

WORDS = b"correct horse"
CLOSE = Address("DOOR", "State_1", "close")
PLACES = {"State_0": (40.0, 40.0), "State_1": (400.0, 40.0)}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "door.json"
    path.write_text(json.dumps(DOOR, indent=1))
    smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
    return path


def approve(file: Path, **more: object) -> None:
    smsl.approve(smsl.ApprovalRequest(smsl.read(file), "ada", WORDS, **more))  # type: ignore[arg-type]


def says_below(person: Person, words: str) -> None:
    person.until(lambda: person.window.toast.words == words)


def says(person: Person, words: str) -> None:
    person.until(lambda: person.window.features.approval.badge.text() == words)


def test_without_a_record_nobody_has_inspected_it(sit: Sit, file: Path) -> None:
    person = sit(file)
    says(person, "Uninspected")
    person.click(person.window.features.approval.badge)
    card = person.window.features.approval.card
    assert card is not None
    assert any("Nobody has signed" in line for line in card.lines)
    assert any("smsl-studio approve" in line for line in card.lines)
    card.close()


def test_what_was_computed_says_so_until_a_record_covers_it(sit: Sit, file: Path) -> None:
    origin = {"how": "rules", "from": "door.toml", "digest": "0" * 64}
    file.write_text(json.dumps({**DOOR, "_origin": origin}, indent=1))
    person = sit(file)
    says(person, "Generated, not inspected")
    badge = person.window.features.approval.badge
    assert not badge.said.is_good
    assert any("_origin says how" in line for line in badge.said.lines)
    approve(file)
    person.window.features.approval.look_again()
    says(person, "Approved by 1")


def test_it_follows_the_record_and_every_change(sit: Sit, file: Path) -> None:
    approve(file)
    person = sit(file)
    badge = person.window.features.approval.badge
    says(person, "Approved by 1")
    assert badge.said.is_good
    assert "Ada Lovelace (engineer)" in badge.accessibleDescription()
    gone = (Address("DOOR", "State_1", "close"),)
    person.window.session.edit("Delete close", lambda blueprint: delete(blueprint, gone))
    says(person, "Changed since signed")
    assert not badge.said.is_good
    person.window.session.history.undo()
    says(person, "Approved by 1")


def test_what_others_sign_meanwhile_is_seen(
    sit: Sit, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(feature, "WATCH", 50)
    person = sit(file)
    says(person, "Uninspected")
    approve(file)
    says(person, "Approved by 1")
    smsl.revoke_key("ada", "it was stolen", WORDS)
    says(person, "Revoked")


def test_a_rejection_and_an_open_condition_are_told(sit: Sit, file: Path) -> None:
    approve(file, conditions=("the drill is calibrated",))
    says(sit(file), "Approved with conditions")
    approve(file, verdict="rejected")
    says(sit(file), "Rejected")


def test_a_policy_of_the_project_is_asked_by_the_badge_and_by_play(sit: Sit, file: Path) -> None:
    approve(file)
    policy = Path(written_policy(file.parent, "persons = 2"))
    person = sit(file)
    approval = person.window.features.approval
    approval.ask_file = lambda folder: policy
    person.window.actions_table["choose_policy"].trigger()
    says(person, "Signature missing")
    person.window.actions_table["approval_reasons"].trigger()
    assert approval.card is not None
    lines = approval.card.lines
    assert "2 persons must approve it, and 1 does (too_few_persons)" in lines
    assert "Trust policy: policy.toml" in lines
    approval.card.close()
    person.window.actions_table["run_play"].trigger()
    pane = person.window.features.run.pane
    person.until(lambda: "too_few_persons" in pane.canvas.canvas.overlays.banner.text)
    assert pane.run.record is not None
    assert b'"code":"too_few_persons"' in pane.run.record.read_bytes()
    person.window.actions_table["drop_policy"].trigger()
    says(person, "Approved by 1")


def test_the_evidence_has_the_runs_of_what_is_saved_and_a_bare_python_checks_it(
    sit: Sit, file: Path, tmp_path: Path
) -> None:
    approve(file)
    person = sit(file)
    person.window.actions_table["run_play"].trigger()
    run = person.window.features.run.pane.run
    person.until(lambda: run.status is not None and not run.exists)
    approval = person.window.features.approval
    approval.ask_bundle = lambda suggested: suggested.with_name("evidence.zip")
    person.window.actions_table["export_evidence"].trigger()
    says_below(person, "evidence.zip has the evidence, with 1 recorded run")
    folder = tmp_path / "bare"
    with zipfile.ZipFile(file.with_name("evidence.zip")) as found:
        found.extractall(folder)
    checked = subprocess.run(
        [sys.executable, "verify.py"], cwd=folder, capture_output=True, text=True, check=False
    )
    assert (checked.returncode, checked.stderr) == (0, ""), checked.stdout
    gone = (Address("DOOR", "State_1", "close"),)
    person.window.session.edit("Delete close", lambda blueprint: delete(blueprint, gone))
    person.window.actions_table["export_evidence"].trigger()
    says_below(person, "Save the blueprint first. The evidence is about what is saved")


def test_what_changed_since_the_last_signature_is_shown_on_the_drawing(
    sit: Sit, file: Path
) -> None:
    approve(file)
    person = sit(file)
    says(person, "Approved by 1")
    session = person.window.session
    session.edit("Rename", lambda blueprint: add_state(blueprint, "DOOR", "State_2"))
    session.edit("Move", lambda blueprint: set_layout(blueprint, "DOOR", PLACES))
    session.edit("Delete close", lambda blueprint: delete(blueprint, (CLOSE,)))
    says(person, "Changed since signed")
    person.click(person.window.features.approval.badge)
    card = person.window.features.approval.card
    assert card is not None
    button = next(one for one in card.buttons if one.text() == "Show what changed")
    person.click(button)
    person.until(lambda: person.window.comparing.dialog is not None)
    dialog = person.window.comparing.dialog
    assert dialog is not None
    rows = [row.text for row in dialog.changes.rows.rows]
    assert "close" in rows[0]
    assert "State_2" in rows[1]
    assert "line" not in dialog.changes.rows.rows[0].right
    assert len(rows) == 2, "a signed content has no layout, so nothing has moved"
    assert dialog.before.has(CLOSE)
    assert not dialog.after.has(CLOSE)
    session.history.undo()
    person.until(lambda: len(dialog.changes.rows.rows) == 1)


def test_recent_files_have_the_badge(sit: Sit, file: Path) -> None:
    approve(file)
    other = file.with_name("other.json")
    other.write_bytes(file.read_bytes())
    settings = Settings()
    settings.remember(other)
    settings.remember(file)
    settings.sync()
    person = sit(begin=False)
    column = person.window.features.start.part().column
    person.until(
        lambda: [row.badge_words for row in column.rows] == ["Approved by 1", "Uninspected"]
    )
    assert "Approved by 1" in column.rows[0].accessibleDescription()
