"""A person goes from a text to a checked blueprint on the page Design cycle."""

from __future__ import annotations

import json
import threading
from dataclasses import replace
from functools import cache
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import pytest

from smsl_studio.front import generated_text
from smsl_studio.front.design import stages
from smsl_studio.front.design.cycle import DesignCycle
from smsl_studio.front.design.notes import read_notes, write_notes
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.features.design import request_dialog
from smsl_studio.studio.features.design.page import CyclePage
from smsl_studio.studio.features.design.request_dialog import (
    ANSWERS,
    SERVER,
    FileQuestions,
    RequestDialog,
)
from smsl_studio.studio.features.design.side_rows import PartRow
from tests.cases import case
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

LAMP = "# Lamp\n\n1. Switch the lamp on.\n2. Look at the light.\n3. Switch the lamp off.\n"


class AtCycle:
    """The page Design cycle of a person's window."""

    def __init__(self, person: Person) -> None:
        self.person, self.feature = person, person.window.features.design

    @property
    def page(self) -> CyclePage:
        return self.feature.part()

    @property
    def cycle(self) -> DesignCycle:
        assert self.page.cycle is not None
        return self.page.cycle

    def until(self, number: int, standing: str) -> None:
        self.person.until(
            lambda: (
                self.page.cycle is not None
                and self.cycle.stage(number).standing == standing
                and self.page.board.cards[number - 1].stage == self.cycle.stage(number)
            )
        )

    def choose(self, number: int) -> None:
        self.person.click(self.page.board.cards[number - 1])

    def act(self, number: int) -> None:
        self.choose(number)
        self.person.click(self.page.side.act)

    @property
    def dialog(self) -> RequestDialog:
        self.person.until(lambda: self.feature.texts.dialog is not None)
        assert self.feature.texts.dialog is not None
        return self.feature.texts.dialog

    def begin(self) -> None:
        self.person.click(self.dialog.begin)

    def words(self) -> list[str]:
        return [row.text() if hasattr(row, "text") else "" for row in self.page.side.rows]


@cache
def _offers() -> Loaded:
    """What plugins offer: asked once for all stories, because each time takes a process."""
    return describe()


@pytest.fixture
def lamp(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A text, which whoever is asked for a file gives as the answer."""
    text = tmp_path / "lamp.md"
    text.write_text(LAMP, "utf-8")
    asked = FileQuestions(lambda *_: str(text), lambda *_: str(tmp_path / "answers"), lambda *_: "")
    defaults = (*(request_dialog.RequestDialog.__init__.__defaults__ or ())[:-1], asked)
    monkeypatch.setattr(generated_text, "describe", _offers)
    monkeypatch.setattr(request_dialog.RequestDialog.__init__, "__defaults__", defaults)
    return text


def made(sit: Sit, lamp: Path) -> AtCycle:
    """The page, with a blueprint that was made of the text from the empty studio."""
    at = AtCycle(sit(begin=False))
    start = at.person.window.features.start.part()
    at.person.click(start.column.links.texts)
    at.person.click(at.dialog.add)
    assert at.dialog.target.text() == str(lamp.parent / "lamp-blueprint" / "lamp.json")
    at.begin()
    at.until(stages.FSM, stages.UNINSPECTED)
    return at


def test_from_a_text_to_a_checked_and_swept_blueprint(sit: Sit, lamp: Path) -> None:
    at = made(sit, lamp)
    window, folder = at.person.window, lamp.parent / "lamp-blueprint"
    assert window.mode == "cycle"
    assert window.files.path == folder / "lamp.json"
    assert window.features.approval.badge.text() == "Generated, not inspected"
    assert at.cycle.stage(stages.TEXT).verdict.words == "1 text, 5 lines"
    first, *others = [row for row in at.page.side.rows if isinstance(row, PartRow)]
    # A citation opens the text at its line; the part beside it leads to the drawing.
    at.person.click(others[1].citation)
    text = at.feature.verbs.text
    assert text is not None
    assert text.marked.endswith("2. Look at the light.")
    text.close()
    at.act(stages.BRANCHES)
    at.person.until(lambda: at.cycle.stage(stages.BRANCHES).maker is not None)
    assert at.cycle.stage(stages.BRANCHES).verdict.words == "0 sub-SBs, 2 cuts possible"
    at.act(stages.CODE)
    at.person.until(lambda: (folder / "lamp-program" / "pyproject.toml").exists())
    at.choose(stages.TESTING)
    at.feature.verbs.sweep_in("table")
    at.until(stages.TESTING, stages.SETTLED)
    assert at.cycle.stage(stages.TESTING).verdict.words == "Sweep 3 of 3"
    assert at.cycle.stage(stages.INSPECTION).standing == stages.SETTLED
    at.choose(stages.FSM)
    beside = next(row for row in at.page.side.rows if isinstance(row, PartRow))
    at.person.click(beside.element)
    assert window.mode == "draw"
    assert str(window.session.selection[0]) == str(beside.part.address)
    assert first.part == beside.part


def test_a_change_of_the_text_is_seen_generated_anew_and_taken_with_what_was_drawn(
    sit: Sit, lamp: Path
) -> None:
    at = made(sit, lamp)
    window = at.person.window
    session = window.session
    window.set_mode("draw")
    text = session.blueprint.document.text.replace("Look at the light", "Look at the lamp")
    session.write("Another title", text)
    assert window.files.save()
    lamp.write_text(LAMP.replace("off.", "off.\n4. Lock the door."), "utf-8")
    window.set_mode("cycle")
    at.until(stages.FSM, stages.OUTDATED)
    assert at.cycle.stage(stages.FSM).foot == "Stage 1 changed"
    maker = at.cycle.stage(stages.FSM).maker
    assert maker is not None
    assert maker.words == "Reader, no model, then by hand"
    before = session.blueprint
    at.act(stages.FSM)
    assert at.dialog.texts.item(0).text() == str(lamp)
    assert not at.dialog.target.isVisible()
    at.begin()
    at.person.until(lambda: at.page.new is not None)
    assert session.blueprint is before
    assert "4. Lock" in lamp.read_text("utf-8")
    assert any("Op_LockDoor" in words for words in at.words())
    at.person.click(at.page.bar.take)
    at.until(stages.FSM, stages.UNINSPECTED)
    # The person's title stays, and the new step is there; one step of the history takes it back.
    branch = session.blueprint["LAMP"]
    assert "Op_LockDoor" in branch.operation_names
    assert branch.operation_note("State_1000", "Op_LookLight").title == "Look at the lamp"
    assert (lamp.parent / "lamp-blueprint" / "former-1" / "pm.md").exists()
    window.actions_table["undo"].trigger()
    assert session.blueprint == before


def test_a_new_blueprint_in_the_place_of_another_is_a_step_of_its_history(
    sit: Sit, lamp: Path
) -> None:
    at = made(sit, lamp)
    window, file = at.person.window, lamp.parent / "lamp-blueprint" / "lamp.json"
    values = json.loads(file.read_text("utf-8"))
    values["LAMP"]["State_000"]["Op_ByHand"] = "State_111"
    file.write_text(json.dumps(values), "utf-8")
    mine = file.read_text("utf-8")
    window.actions_table["new"].trigger()
    lamp.write_text(LAMP.replace("light", "bulb"), "utf-8")
    window.actions_table["from_text"].trigger()
    at.person.click(at.dialog.add)
    assert at.dialog.target.text() == str(file)
    at.begin()
    at.person.until(at.page.bar.take.isVisible)
    assert "no difference" not in at.page.bar.words.text()
    at.person.click(at.page.bar.take)
    assert window.files.path == file
    assert {"Op_ByHand", "Op_LookBulb"} <= set(window.session.blueprint["LAMP"].operation_names)
    assert file.read_text("utf-8") == mine
    window.actions_table["undo"].trigger()
    assert "Op_LookBulb" not in set(window.session.blueprint["LAMP"].operation_names)
    # What is no blueprint is moved away, and the bar says so first.
    file.write_text("my list", "utf-8")
    window.actions_table["new"].trigger()
    window.actions_table["from_text"].trigger()
    at.person.click(at.dialog.add)
    at.begin()
    at.person.until(at.page.bar.take.isVisible)
    assert "lamp.json is there already and is no blueprint" in at.page.bar.words.text()
    at.person.click(at.page.bar.take)
    at.until(stages.FSM, stages.UNINSPECTED)
    assert "my list" in {one.read_text("utf-8") for one in file.parent.glob("former-*/lamp.json")}


def test_a_person_may_say_that_a_stage_still_holds(sit: Sit, lamp: Path) -> None:
    at = made(sit, lamp)
    at.person.window.set_mode("draw")
    lamp.write_text(f"{LAMP}\nThank you.\n", "utf-8")
    at.person.window.set_mode("cycle")
    at.until(stages.FSM, stages.OUTDATED)
    at.choose(stages.FSM)
    at.person.click(at.page.side.holds)
    at.until(stages.FSM, stages.UNINSPECTED)
    assert not at.page.side.holds.isVisible()
    # A note may name any file as a text; the desktop is not asked to open a program.
    file = lamp.parent / "lamp-blueprint" / "lamp.json"
    program = lamp.rename(lamp.with_name("lamp.sh"))
    write_notes(replace(read_notes(str(file)), texts=(program,)), str(file))
    at.person.window.set_mode("draw")
    at.person.window.set_mode("cycle")
    at.person.until(lambda: any(one.path == program for one in at.cycle.texts))
    at.choose(stages.TEXT)
    at.person.click(at.page.side.edit)
    assert "lamp.sh is opened by no program" in at.person.window.toast.words


def test_a_function_that_was_written_is_read_and_allowed(sit: Sit, lamp: Path) -> None:
    at = made(sit, lamp)
    at.person.window.set_mode("draw")
    function = "def op_look_light(world):\n    yield\n"
    (lamp.parent / "lamp-blueprint" / "rmm" / "LAMP.Op_LookLight.py").write_text(function, "utf-8")
    at.person.window.set_mode("cycle")
    at.choose(stages.CODE)
    at.person.click(at.page.side.read)
    dialog = at.feature.verbs.reading
    assert dialog is not None
    assert "+def op_look_light(world):" in dialog.difference.toPlainText()
    at.person.click(dialog.allow)
    at.person.until(lambda: at.cycle.functions.is_read)
    assert "Allowed" in at.person.window.toast.words
    assert not at.page.side.read.isVisible()


def test_by_hand_says_what_is_missing_and_goes_on_when_it_is_there(sit: Sit, lamp: Path) -> None:
    at = AtCycle(sit(begin=False))
    at.person.window.actions_table["from_text"].trigger()
    at.person.click(at.dialog.add)
    at.dialog.who.setCurrentText(next(iter(w for w, p in ANSWERS.items() if p == "by-hand")))
    assert not at.dialog.begin.isEnabled()
    answers = lamp.parent / "answers"
    at.dialog.where.setText(str(answers))
    at.begin()
    at.person.until(lambda: (answers / "pm.prompt.md").exists())
    at.person.until(at.page.bar.again.isVisible)
    assert "pm.md is missing" in at.page.bar.words.text()
    (answers / "pm.md").write_text("1. Switch the lamp on.\n2. Go.\n", "utf-8")
    at.person.click(at.page.bar.again)
    at.person.until(lambda: "him.toml is missing" in at.page.bar.words.text())
    assert at.person.blueprint.state_count == 0
    at.person.click(at.page.bar.leave)
    assert not at.page.bar.isVisible()


class _Silent(BaseHTTPRequestHandler):
    """A server that hears a question and answers nothing until the test ends."""

    asked, ends = threading.Event(), threading.Event()

    def do_POST(self) -> None:
        self.asked.set()
        self.ends.wait(30)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Write nothing."""


def test_a_silent_server_is_cancelled_at_once_and_the_blueprint_stays(sit: Sit, lamp: Path) -> None:
    at = made(sit, lamp)
    before = at.person.blueprint
    server = HTTPServer(("127.0.0.1", 0), _Silent)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        at.act(stages.FSM)
        at.dialog.who.setCurrentText(next(w for w, p in ANSWERS.items() if p == SERVER))
        at.dialog.where.setText(f"http://127.0.0.1:{server.server_port}/v1#small")
        assert "sent to this URL and nowhere else" in at.dialog.told.text()
        at.begin()
        at.person.until(_Silent.asked.is_set)
        # The window still follows the person.
        at.choose(stages.HARDWARE)
        assert at.page.side.title.text() == "Hardware integration"
        at.person.click(at.page.bar.cancel)
        assert not at.page.bar.isVisible()
        assert at.person.blueprint is before
        assert not at.feature.work.generates
    finally:
        _Silent.ends.set()
        server.shutdown()
        server.server_close()


def test_any_stage_of_any_drawing_may_be_entered_and_leads_to_its_page(sit: Sit) -> None:
    at = AtCycle(sit(SAMPLES / "registration.json"))
    window = at.person.window
    window.actions_table["cycle_page"].trigger()
    at.until(stages.FSM, stages.SETTLED)
    modes = {
        stages.FSM: "draw", stages.HFSM: "draw", stages.TESTING: "run",
        stages.INSPECTION: "draw", stages.APPROVAL: "review",
    }  # fmt: skip
    for number in stages.WORDS:
        with case("stage", number):
            window.set_mode("cycle")
            at.choose(number)
            assert at.page.side.title.text() == stages.WORDS[number].name
            for button in (at.page.side.act, at.page.side.edit, at.page.side.open):
                assert button.isHidden() or button.toolTip()
            if number in modes:
                at.person.click(at.page.side.open)
                assert window.mode == modes[number]
    # A drawing with a file has a place for what was tried; a draft has none, and says so.
    window.actions_table["new"].trigger()
    window.set_mode("cycle")
    at.until(stages.HFSM, stages.EMPTY)
    at.act(stages.BRANCHES)
    assert "Save the blueprint first" in window.toast.words
