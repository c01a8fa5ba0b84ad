"""Plugins are edited, added and broken while the window is open, and the work goes on."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio.host.spare import Spare
from smsl_studio.studio.shell.plugins import Plugins
from tests.plugin_folder import write_plugin
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
CODE = """
def register(library):
    @library.world("lamp", engine="table")
    def build(world, blueprint, seed):
        return None

    @library.operation("{name}")
    def work(world):
        yield
"""


def _code(name: str) -> str:
    return CODE.replace("{name}", name)


@pytest.fixture
def plugin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The code of a plugin in a folder that is looked into."""
    folder = write_plugin(tmp_path / "plugins", "lamp", _code("Op_1b"))
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(folder.parent))
    return folder / "plugin.py"


CRASHING = """
import ctypes

def register(library):
    @library.world("lamp", engine="table")
    def build(world, blueprint, seed):
        return None

    @library.arrange("lamp")
    def put(world, facts):
        world.set_facts(facts)

    @library.sensor("eye_{n}", fact="{n}")
    def eye(world, n: int):
        return world.fact("SB1", n - 1)

    @library.operation("Op_{disk}{peg}")
    def work(world, disk: int, peg: str):
        yield
        ctypes.string_at(0)
"""


def _offered(plugins: Plugins) -> list[str]:
    return [
        entry.pattern.text
        for one in plugins.loaded.plugins
        for entry in one.library.operations
        if one.name == "lamp" and entry.pattern
    ]


def test_an_edited_plugin_is_read_again_without_a_restart(sit: Sit, plugin: Path) -> None:
    person = sit(SAMPLES / "hanoi.json")
    plugins = person.windows.plugins
    assert _offered(plugins) == ["Op_1b"]
    plugin.write_text(_code("Op_3c"))
    person.window.actions_table["reload_plugins"].trigger()
    person.until(lambda: _offered(plugins) == ["Op_3c"])
    assert "lamp" in person.window.toast.words


def test_a_plugin_that_crashes_its_process_is_named_and_the_work_goes_on(
    sit: Sit, plugin: Path
) -> None:
    person = sit(SAMPLES / "hanoi.json")
    plugin.write_text("import ctypes; ctypes.string_at(0)")
    plugins = person.windows.plugins
    person.window.actions_table["reload_plugins"].trigger()
    person.until(lambda: bool(plugins.loaded.faults))
    assert "SIGSEGV" in person.window.toast.words
    assert "hanoi" in plugins.loaded.worlds


def test_one_operation_is_tried_alone_from_its_page(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    window = person.window
    alone = window.properties.operation.alone
    window.session.jump(person.blueprint.resolve("SB1/State_cbb/Op_1c"))
    window.properties.ensureWidgetVisible(alone)
    assert alone.world.currentText() == "hanoi", "the world that answers to the name stands first"
    person.choose(alone.world, "table")
    person.click(alone.button)
    person.until(lambda: alone.words.text().startswith("Passed in table"))
    window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    assert not alone.words.isVisible(), "what was said of another operation is gone"


def test_a_misprinted_operation_does_not_pass_in_physics(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    window = person.window
    alone = window.properties.operation.alone
    window.session.jump(person.blueprint.resolve("SB1/State_cbb/Op_1c"))
    window.properties.ensureWidgetVisible(alone)
    person.click(alone.button)
    person.until(lambda: alone.words.text().startswith("Did not pass in hanoi"))


def test_trying_an_operation_can_be_cancelled(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    window = person.window
    alone = window.properties.operation.alone
    window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    window.properties.ensureWidgetVisible(alone)
    person.click(alone.button)
    person.click(alone.button)
    person.until(lambda: alone.button.text() == "Try alone")
    assert "Stopped" in alone.words.text()


def test_a_world_in_waiting_is_what_the_next_run_begins_in(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-2.json")
    spare = Spare()
    person.window.features.run.keep_warm(spare)
    try:
        run = AtRun(person)
        person.until(lambda: spare.pid is not None)
        waiting = spare.pid
        person.press(Key.Key_F5)
        run.until_runs()
        assert run.pane.run.world_process == waiting
        person.press(Key.Key_F8)
    finally:
        person.window.features.run.pane.shut()
        spare.close()


def test_while_one_draws_no_world_is_kept_ready(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-2.json")
    spare = Spare()
    person.window.features.run.keep_warm(spare)
    AtRun(person)
    person.ctrl(Key.Key_1)
    person.window.features.run.warming._warm()
    assert spare.pid is None


def test_an_operation_that_crashes_its_process_costs_the_run_and_the_work_goes_on(
    sit: Sit, plugin: Path
) -> None:
    plugin.write_text(CRASHING)
    person = sit(SAMPLES / "hanoi.json")
    corner = person.place("SB1/State_bbb")
    person.drag(corner, corner + QPoint(0, 30))
    drawn = person.blueprint.document.text
    run = AtRun(person)
    run.choose(world="lamp")
    person.press(Key.Key_F5)
    run.until_phase("Ended: failed")
    assert "SIGSEGV" in run.pane.canvas.banner
    assert "in the middle of SB1/State_aaa/Op_1c" in run.pane.canvas.banner
    person.ctrl(Key.Key_1)
    assert person.blueprint.document.text == drawn
    assert person.window.session.edited
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text != drawn, "one goes on editing, and undoing"
    plugin.write_text(CRASHING.replace("ctypes.string_at(0)", "pass"))
    AtRun(person)
    person.press(Key.Key_F5)
    run.until_phase("Fault hold")
    assert "SIGSEGV" not in run.pane.canvas.banner, "the mended plugin is what the next run has"
