"""A person lets a campaign run, looks at its cells, replays a run, and writes what was measured."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog

from smsl_studio.studio.features.campaign import feature
from smsl_studio.studio.features.campaign.dialog import CampaignDialog
from smsl_studio.studio.features.campaign.page import CampaignPage, duration
from smsl_studio.studio.features.campaign.rates_dialog import RatesDialog
from tests.stories.conftest import Heard, Sit
from tests.stories.person import Person

Key = Qt.Key
DRAWN = {
    "SB": {
        "HEADER": {"INITIAL": "State_a", "ACTIVATING": "State_c"},
        "State_a": {"Go": "State_b"},
        "State_b": {"On": "State_c", "Back": "State_a"},
        "State_c": {"Up": "State_b"},
    }
}


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    file = tmp_path / "way.json"
    file.write_text(json.dumps(DRAWN, indent=4), "utf-8")
    return sit(file)


def page(person: Person) -> CampaignPage:
    return person.window.features.campaign.page


def asked(person: Person) -> CampaignDialog:
    """Open the page and ask for a campaign, by the palette."""
    person.ctrl(Key.Key_K)
    person.type("fault atlas")
    person.press(Key.Key_Return)
    assert person.window.features.run.body is not None
    assert person.window.features.run.body.shown == "Campaign"
    person.click(page(person).begin)
    (dialog,) = person.window.findChildren(CampaignDialog)
    return dialog


def over(person: Person) -> None:
    work = person.window.features.campaign.work
    assert work is not None
    person.qtbot.waitUntil(lambda: not work.moves, timeout=60_000)


def test_a_campaign_runs_and_one_of_its_runs_is_replayed(person: Person, home: Path) -> None:
    dialog = asked(person)
    person.choose(dialog.world, "table")
    dialog.seeds.selectAll()
    QTest.keyClicks(dialog.seeds, "0")
    assert not dialog.begin.isEnabled()
    assert dialog.refusal.text() == "Seeds are a number from 1 to 1,000,000."
    dialog.seeds.setText("3")
    dialog.agents.setText("lmit")
    assert "There is no supervisor lmit" in dialog.refusal.text()
    dialog.agents.setText("")
    person.click(dialog.begin)
    over(person)
    shown, bar = page(person), person.window.features.campaign.row()
    assert shown.done.text() == "24 of 24 runs"
    assert bar.phase.text().endswith("Campaign done")
    assert "digest" in shown.words.text()
    table = shown.table
    assert table.atlas.headerData(1, Qt.Orientation.Horizontal) == "fail"
    assert table.atlas.index(2, 0).data() == "All operations"
    person.click_row(table, "Go")
    table.setFocus()
    person.press(Key.Key_Right)
    chosen = table.chosen
    assert chosen is not None
    assert (chosen.edge, chosen.fault) == ("SB/State_a/Go", "fail")
    said = table.current.index.data(Qt.ItemDataRole.AccessibleTextRole)
    assert said == "Go a → b, fail, 3 held"
    assert "Reached 0 %, 95 % interval 0 to 56 %" in shown.side.between.text()
    person.press(Key.Key_Return)
    person.press(Key.Key_Right)
    assert shown.side.seed == 1
    story = shown.side.story
    person.qtbot.waitUntil(lambda: story.timeline.isVisibleTo(shown), timeout=30_000)
    assert (story.title.text(), story.seen.text()) == ("Run of seed 1", "held")
    assert [lane.label for lane in story.timeline.lanes] == ["State", "Operation"]
    words = [row.text for row in story.events.rows.rows]
    assert "Had something go wrong: fail" in words
    assert words[-1].startswith("The run ended")
    features = person.window.features
    (log,) = home.rglob("way-fail-0-1.jsonl")
    made = log.stat().st_mtime_ns
    person.press(Key.Key_Return)
    person.qtbot.waitUntil(lambda: features.replay.is_open, timeout=30_000)
    recording = features.replay.verbs.replay.recording
    assert recording is not None
    assert recording.path == log
    assert log.stat().st_mtime_ns == made, "what is shown already is not carried out again"
    person.until(lambda: person.window.mode_bar.isVisible())


def test_measured_rates_are_shown_as_a_difference_and_taken_back(person: Person) -> None:
    dialog = asked(person)
    person.choose(dialog.world, "table")
    dialog.seeds.setText("2")
    person.click(dialog.begin)
    over(person)
    before = person.blueprint
    person.click(page(person).rates)
    (rates,) = person.window.findChildren(RatesDialog)
    words = [rates.table.item(0, at) for at in range(5)]
    assert [one.text() for one in words if one is not None] == [
        "SB/State_a/Go", "8 of 8", "68 to 100 %", "1 → 2", "none → high",
    ]  # fmt: skip
    second = rates.table.item(1, 0)
    assert second is not None
    second.setCheckState(Qt.CheckState.Unchecked)
    assert rates.write.text() == "Write 1 operation"
    person.click(rates.write)
    note = person.blueprint["SB"].operation_note("State_a", "Go")
    assert (note.cost, note.risk) == (2, "high")
    assert person.blueprint["SB"].operation_note("State_b", "On").risk is None
    assert "another version" in page(person).words.text()
    assert not page(person).rates.isEnabled()
    assert person.window.toast.words == "Wrote costs and risks of 1 operation."
    person.click(person.window.toast.button)
    assert person.blueprint is before
    assert "another version" not in page(person).words.text()


def test_a_report_is_saved_from_the_window(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    dialog = asked(person)
    person.choose(dialog.world, "table")
    dialog.seeds.setText("2")
    person.click(dialog.begin)
    over(person)
    saved = (("out.html", b"<h1>Campaign of"), ("out.json", b'"digest"'), ("out.parquet", b"PAR1"))
    for name, part in saved:
        place = tmp_path / name
        monkeypatch.setattr(feature, "ask_to_save", lambda *_, place=place: (str(place), ""))
        person.click(person.window.features.campaign.row().export)
        assert part in place.read_bytes()


def test_pause_keeps_what_is_done_and_resume_goes_on(person: Person, heard: Heard) -> None:
    dialog = asked(person)
    person.choose(dialog.world, "table")
    dialog.seeds.setText("400")
    dialog.workers.setValue(2)
    person.click(dialog.begin)
    work, bar = person.window.features.campaign.work, person.window.features.campaign.row()
    assert work is not None
    person.qtbot.waitUntil(lambda: work.tally.done > 0, timeout=30_000)
    person.press(Key.Key_F6)
    person.qtbot.waitUntil(lambda: work.phase == "paused", timeout=30_000)
    done = work.tally.done
    assert 0 < done < work.tally.every
    assert bar.turn.accessibleName() == "Resume"
    person.press(Key.Key_F5)
    person.qtbot.waitUntil(lambda: work.tally.done >= done, timeout=30_000)
    assert bar.stop.isEnabled()
    person.press(Key.Key_F8)
    assert work.phase == "paused"
    assert work.tally.done >= done


def test_what_cannot_be_carried_out_is_said(sit: Sit) -> None:
    person = sit()
    campaign = person.window.features.campaign
    campaign.show()
    person.click(page(person).begin)
    (dialog,) = person.window.findChildren(CampaignDialog)
    person.click(dialog.begin)
    over(person)
    assert "workers need a blueprint in a file" in person.window.toast.words.lower()
    assert page(person).begin.isVisible()
    assert all(isinstance(one, QDialog) for one in (dialog,))


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.2, "1 s"), (80, "80 s"), (600, "10 min"), (9000, "2.5 h")]
)
def test_the_time_that_is_left_is_coarse(seconds: float, words: str) -> None:
    assert duration(seconds) == words


def test_what_ended_otherwise_becomes_a_note_that_can_be_taken_back(person: Person) -> None:
    dialog = asked(person)
    person.choose(dialog.world, "table")
    dialog.seeds.setText("1")
    person.click(dialog.begin)
    over(person)
    shown, before = page(person), person.blueprint
    shown.table.choose("SB/State_a/Go", "fail")
    assert shown.table.chosen is not None
    assert shown.side.foreseen.text().startswith("Foreseen: held"), "there is no other way"
    assert shown.differ.text().endswith("  0")
    shown.finding_wanted.emit(shown.table.chosen)
    (note,) = person.blueprint["SB"].drawn.notes.values()
    assert note.text.startswith("Campaign in the world table: fail in Go. Foreseen: held")
    assert note.state == "State_a"
    assert [str(one) for one in person.window.session.selection] == ["SB/State_a/Go"]
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before.document.text
