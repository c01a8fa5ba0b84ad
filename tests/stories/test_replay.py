"""A recorded run in the window: opened, scrubbed, stepped, played; no command is possible."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

import smsl_studio as smsl
from smsl_studio.errors import ReadError
from smsl_studio.front.recordings import open_recording, recordings_in
from smsl_studio.front.views.states import short_name
from smsl_studio.front.views.timeline_lanes import present_blocks
from smsl_studio.studio.features.replay.pane import ReplayPane
from smsl_studio.studio.features.replay.replay import Replay
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
HFSM, HANOI = SAMPLES / "hfsm.json", SAMPLES / "hanoi-corrected.json"
PRUNED = SAMPLES / "scripts" / "hanoi-pruned.jsonl"


def _recorded(folder: Path) -> Path:
    """A run with a script: an edge is pruned on the way."""
    blueprint, log = smsl.read(HANOI), folder / "run.jsonl"
    script = smsl.read_script(PRUNED, blueprint)
    smsl.run(blueprint, script=script, avoid=["State_aaa/Op_1c"], log=log)
    return log


class AtReplay:
    """Replay mode of a person's window."""

    def __init__(self, person: Person) -> None:
        self.person = person
        self.replay: Replay = person.window.features.replay.verbs.replay
        self.pane: ReplayPane = person.window.features.replay.verbs.pane
        self.bar = person.window.features.replay.verbs.transport

    def active(self) -> dict[str, str]:
        return dict(self.replay.story.moment.configuration)

    def lit(self) -> str | None:
        return self.pane.canvas.canvas.marks.active

    def event(self) -> str:
        """The words of the event that is marked."""
        return str(self.pane.events.currentIndex().data())

    def click_event(self, words: str) -> None:
        """Click the first line that has these words."""
        table = self.pane.events
        model = table.model()
        row = next(
            model.index(at, 0)
            for at in range(model.rowCount())
            if words in str(model.index(at, 0).data())
        )
        table.scrollTo(row)
        QTest.mouseClick(table.viewport(), LEFT, pos=table.visualRect(row).center())

    def click_scrubber(self, share: float) -> None:
        scrubber = self.bar.scrubber
        QTest.mouseClick(scrubber, LEFT, pos=QPoint(round(scrubber.width() * share), 20))


def test_a_run_of_the_window_is_opened_again_and_jumped_about_in(sit: Sit, home: Path) -> None:
    run = AtRun(sit(HFSM))
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    (path,) = (home / "recordings").glob("*.jsonl")
    window = run.person.window
    window.open_path(path)
    at = AtReplay(run.person)
    assert window.mode == "replay"
    assert at.active() == {"SB1": "State000", "SB2": "State0"}
    assert "Verified" in at.pane.note.text()
    at.click_event("SB1/State000/Operation000 became true")
    assert at.active()["SB1"] == "State100"
    assert at.lit() == "State100"
    run.person.press(Key.Key_F10)
    assert at.replay.story.moment.started
    run.person.press(Key.Key_F10, [Qt.KeyboardModifier.ShiftModifier])
    assert at.active()["SB1"] == "State100"
    assert not at.replay.story.moment.started
    at.click_scrubber(0.999)
    assert at.replay.phase == "goal_reached"
    assert at.active() == run.active()


def test_everything_says_that_it_is_a_replay_and_nothing_can_be_commanded(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(HANOI)
    person.window.open_path(_recorded(tmp_path))
    at = AtReplay(person)
    assert at.pane.note.text().startswith("REPLAY of run.jsonl")
    assert at.bar.mark.text() == "REPLAY"
    assert person.window.status_line.words.startswith("REPLAY | World table")
    said = [part.text() for part in person.window.status_line.run_right]
    assert "Recorded, nothing can be commanded" in said
    assert not person.window.features.run.pane.run.exists
    person.press(Key.Key_F8)
    person.press(Key.Key_F10)
    assert not person.window.features.run.pane.run.exists
    assert at.replay.index > 0


def test_the_moment_of_a_prune_shows_what_was_pruned_and_by_whom(sit: Sit, tmp_path: Path) -> None:
    person = sit(HANOI)
    person.window.open_path(_recorded(tmp_path))
    at = AtReplay(person)
    at.click_event("was shut out")
    assert "L. Brandt" in at.event()
    marks = at.pane.canvas.canvas.marks
    assert [str(address) for address in marks.pruned] == ["SB1/State_cba/Op_1b"]
    assert [address.operation for address in marks.trail] == ["Op_1b", "Op_1c", "Op_2b"]
    at.replay.to_index(0)
    assert not at.pane.canvas.canvas.marks.pruned
    facts = at.pane.facts.model()
    at.click_scrubber(0.999)
    assert [facts.index(row, 2).data() for row in range(3)] == ["c", "c", "c"]


def test_a_click_on_the_timeline_goes_there(sit: Sit, tmp_path: Path) -> None:
    person = sit(HANOI)
    person.window.open_path(_recorded(tmp_path))
    at = AtReplay(person)
    plot = at.pane.timeline.plot
    scene = plot.plotItem.vb.mapViewToScene(QPointF(at.replay.end / 2, 10.0))
    QTest.mouseClick(plot.viewport(), LEFT, pos=plot.mapFromScene(scene))
    person.until(lambda: abs(at.replay.time - at.replay.end / 2) < at.replay.end / 20)
    assert 0 < at.replay.index < at.replay.count


def test_keys_in_the_list_of_events_go_where_they_lead(sit: Sit, tmp_path: Path) -> None:
    """What is marked in the list and what is shown are one moment."""
    person = sit(HANOI)
    person.window.open_path(_recorded(tmp_path))
    at = AtReplay(person)
    at.click_event("became true")
    here = at.replay.story.moment.index
    QTest.keyClick(at.pane.events, Key.Key_Up)
    assert at.replay.story.moment.index == here - 1
    QTest.keyClick(at.pane.events, Key.Key_Home)
    assert at.replay.story.moment.index == 1
    assert "The run begins" in at.event()


def test_it_plays_to_its_end_and_is_closed(sit: Sit, tmp_path: Path) -> None:
    person = sit(HANOI)
    person.window.open_path(_recorded(tmp_path))
    at = AtReplay(person)
    person.choose(at.bar.speed, "¼×")
    played: list[bool] = []
    at.replay.changed.connect(lambda: played.append(at.replay.playing))
    person.press(Key.Key_F5)
    assert played, "nothing has begun to play"
    assert played[0]
    person.until(lambda: not at.replay.playing)
    assert at.replay.index == at.replay.count
    person.click(at.bar.leave)
    assert person.window.mode == "run"
    assert not person.window.features.replay.verbs.is_open


def test_a_log_that_was_changed_opens_with_a_clear_mark(sit: Sit, tmp_path: Path) -> None:
    log = _recorded(tmp_path)
    raw = log.read_bytes()
    log.write_bytes(raw.replace(b'"seed":0', b'"seed":1'))
    person = sit(HANOI)
    person.window.open_path(log)
    at = AtReplay(person)
    assert "NOT VERIFIED, line 1" in at.pane.note.text()
    assert isinstance(at.pane.note, QLabel)
    assert at.pane.note.property("kind") == "bad"


def test_without_the_file_of_the_drawing_it_is_found_or_asked_for(sit: Sit, tmp_path: Path) -> None:
    log = _recorded(tmp_path)
    person = sit(HFSM)
    person.window.open_path(log)
    at = AtReplay(person)
    assert at.replay.blueprint is not None
    assert at.replay.blueprint.file == str(HANOI)
    lost = tmp_path / "lost.jsonl"
    lost.write_bytes(log.read_bytes().replace(b"hanoi-corrected.json", b"nowhere-to-be.json"))
    person.click(at.bar.leave)
    person.window.open_path(lost)
    assert "is not found" in person.window.toast.words
    assert not person.window.features.replay.verbs.is_open


def test_a_log_does_not_have_any_file_opened_that_it_names(tmp_path: Path) -> None:
    log, nothing = _recorded(tmp_path), smsl.read(HFSM)
    other, pipe = tmp_path / "secret", tmp_path / "pipe.json"
    shutil.copy(HANOI, other)
    os.mkfifo(pipe)
    assert open_recording(log, nothing).blueprint.file == str(HANOI)
    raw = log.read_bytes()
    for named in (other, pipe, Path("/proc/kmsg"), Path("/dev/zero")):
        log.write_bytes(raw.replace(os.fsencode(HANOI), os.fsencode(named)))
        with pytest.raises(ReadError, match="is not found"):
            open_recording(log, nothing)


def test_a_recording_that_is_gone_hides_no_other(tmp_path: Path) -> None:
    log = _recorded(tmp_path)
    (tmp_path / "gone.jsonl").symlink_to(tmp_path / "nothing")
    assert recordings_in(tmp_path) == (log,)


Slow = tuple[Path, Callable[[], None]]


@pytest.fixture
def slow(tmp_path: Path) -> Iterator[Slow]:
    """A log that comes through a pipe, and what has it come."""
    raw = _recorded(tmp_path).read_bytes()
    path = tmp_path / "slow.jsonl"
    reader, writer = os.pipe()
    path.symlink_to(f"/dev/fd/{reader}")

    def come() -> None:
        with os.fdopen(writer, "wb") as stream:
            stream.write(raw)

    yield path, come
    os.close(reader)


def test_a_log_that_takes_long_is_read_beside_the_window(sit: Sit, slow: Slow) -> None:
    person = sit(HANOI)
    path, come = slow
    replaying = person.window.features.replay.verbs
    replaying.open(path)
    person.until(replaying.card.isVisible)
    assert replaying.card.words.text() == "Reading slow.jsonl, 0%"
    assert person.window.mode == "draw"
    come()
    person.until(lambda: replaying.is_open)
    assert person.window.mode == "replay"
    assert not replaying.card.isVisible()
    assert "Verified" in replaying.pane.note.text()


def test_a_log_that_takes_long_can_be_given_up(sit: Sit, tmp_path: Path, slow: Slow) -> None:
    person = sit(HANOI)
    path, come = slow
    replaying = person.window.features.replay.verbs
    replaying.open(path)
    person.click(replaying.card.cancel)
    assert not replaying.card.isVisible()
    come()
    replaying.open(tmp_path / "run.jsonl")
    assert replaying.is_open
    QApplication.processEvents()
    recording = replaying.replay.recording
    assert recording is not None
    assert recording.path.name == "run.jsonl"


def test_what_is_no_log_is_refused(sit: Sit, tmp_path: Path) -> None:
    person = sit(HFSM)
    path = tmp_path / "notes.jsonl"
    path.write_text("nothing\n")
    person.window.features.replay.verbs.open(path)
    assert not person.window.features.replay.verbs.is_open
    assert "no run log" in person.window.toast.words


def test_the_timeline_marks_what_the_shown_event_says(tmp_path: Path) -> None:
    recording = open_recording(_recorded(tmp_path), smsl.read(HANOI))
    (branch,) = recording.blueprint
    (states,) = (row for row in recording.lanes if row.kind == "state")
    operations = [row for row in recording.lanes if row.kind == "operation"]
    twice = 0
    for index in range(len(recording.playback) + 1):
        moment = recording.playback.at(index)
        marked = present_blocks(recording.blueprint, recording.lanes, moment)
        shown = {recording.lanes[row].blocks[at].words for row, at in marked}
        state = moment.configuration.get(branch.name)
        twice += sum(block.start == moment.time for block in states.blocks) > 0
        running = moment.running.rpartition("/")[2]
        assert shown == {short_name(branch, one) for one in [state] if one} | (
            {running} if running else set()
        )
    assert twice > len(states.blocks), "several events have the time of a new state"
    assert operations
