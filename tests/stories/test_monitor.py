"""The monitor page: the reading of every sensor, why a fact is unknown, and disturbances."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu

from smsl_studio.front.views.monitor_rows import MonitorRow
from smsl_studio.studio.features.monitor.page import MonitorPage
from smsl_studio.studio.features.monitor.window import MonitorWindow
from tests.monitor.broker import Broker, Node, with_ages
from tests.stories.at_run import PATIENCE, AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key


class AtMonitor:
    """A run by hand with the monitor page before it."""

    def __init__(self, run: AtRun) -> None:
        self.run, self.person = run, run.person

    @property
    def page(self) -> MonitorPage:
        return self.person.window.features.monitor.inside().sensors

    @property
    def window(self) -> MonitorWindow:
        window = self.person.window.features.monitor.opener.window
        assert window is not None
        return window

    def open(self) -> MonitorPage:
        """By its key; then the table has the focus."""
        self.person.ctrl(Key.Key_M)
        self.person.until(self.page.isVisible)
        return self.page

    def open_apart(self) -> MonitorWindow:
        """In a window of its own, by the button on the page."""
        page = self.page if self.page.isVisible() else self.open()
        self.person.click(page.apart)
        self.person.until(self.window.isVisible)
        return self.window

    def row(self, *key: str) -> MonitorRow:
        return next(row for row in self.page.rows if row.key == key)

    def until_cells(self, *key: str, **cells: str) -> None:
        """Until the columns of a row say so."""
        columns = {"value": 2, "quality": 3, "disturbed": 9}

        def there() -> None:
            found = self.row(*key).cells
            said = {name: found[columns[name]] for name in cells}
            assert all(said[name].startswith(cells[name]) for name in cells), said
            assert [said[n] for n in cells if not cells[n]] == [""] * list(cells.values()).count("")

        self.person.qtbot.waitUntil(there, timeout=PATIENCE)

    def go_to(self, *key: str) -> None:
        """Down to a row, by keys."""
        table = self.page.table
        QTest.keyClick(table, Key.Key_Home, Qt.KeyboardModifier.ControlModifier)
        for _ in self.page.rows:
            if table.chosen is not None and table.chosen.key == key:
                return
            QTest.keyClick(table, Key.Key_Down)
        raise AssertionError(f"no way down to {key}")


def _by_hand(sit: Sit, path: Path) -> AtMonitor:
    run = AtRun(sit(path))
    run.choose(world="table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    return AtMonitor(run)


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.kill()


@pytest.fixture
def node(broker: Broker) -> Iterator[Node]:
    made = Node(broker, "SB1/0:eye=a")
    yield made
    made.kill()


def test_an_unknown_fact_turns_known(sit: Sit, tmp_path: Path, broker: Broker, node: Node) -> None:
    path = with_ages("hanoi-2", tmp_path)
    text = f'[mqtt]\nbroker = "{broker.address}"\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n'
    path.with_suffix(".toml").write_text(text, "utf-8")
    at = _by_hand(sit, path)
    page = at.open()
    fact = ("SB1", "0")
    at.until_cells(*fact, value="a", quality="good")
    assert at.row(*fact).cells[:2] == ("Fact 1", "eye")
    assert at.run.pane.run.world_process is not None
    assert page.words.text() == "2 facts: 2 known"

    node.say("eye ?")
    at.until_cells(*fact, value="?", quality="the sensor has no valid reading")
    assert page.words.text() == "2 facts: 1 known, 1 unknown"
    assert at.row("SB1").cells[3].startswith("by its sensors: unknown, could be State_aa")
    card = page.checks.cards["SB1"].accessibleName()
    assert card.startswith("SB1, active State_aa: lambda s: [f1(s), f2(s)], unknown: f1(s) unknown")
    assert "f2(s) true, Fact 2 reads a" in card

    node.freeze()
    at.until_cells(*fact, value="?", quality="no reading for ")
    rows = page.network.rows
    at.person.until(lambda: any("frozen" in row.right for row in rows.rows))

    node.thaw()
    node.say("eye a")
    at.until_cells(*fact, value="a", quality="good")
    at.person.until(lambda: any(row.right == "alive" for row in rows.rows))
    assert page.words.text() == "2 facts: 2 known"
    assert at.row("SB1").cells[3] == "by its sensors: located, State_aa"


def test_a_sensor_is_disturbed_from_its_row_with_keys_alone(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    page, fact = at.open(), ("SB1", "0")
    at.until_cells(*fact, value="a", disturbed="")
    at.go_to(*fact)
    bar = page.bar
    bar.kind.setFocus()
    QTest.keyClicks(bar.kind, "Drop")
    assert (bar.kind.currentText(), bar.parameter.text()) == ("Dropout", "1")
    bar.parameter.setFocus()
    QTest.keyClick(bar.parameter, Key.Key_Return)
    at.until_cells(*fact, value="?", quality="no reading for ", disturbed="dropout")
    bar.off.setFocus()
    QTest.keyClick(bar.off, Key.Key_Space)
    at.until_cells(*fact, value="a", quality="good", disturbed="")


def test_something_goes_wrong_in_the_world_and_what_is_refused_says_why(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    page, fact = at.open(), ("SB1", "0")
    at.until_cells(*fact, value="a", disturbed="")
    bar = page.faults
    bar.fault.setFocus()
    QTest.keyClicks(bar.fault, "set")
    assert bar.fault.currentData() == "set"
    bar.parameters.setFocus()
    QTest.keyClicks(bar.parameters, "fact SB1/0")
    QTest.keyClick(bar.parameters, Key.Key_Return)
    assert bar.refusal.startswith("Fact is no name=value")
    bar.parameters.setText("fact=SB1/9 value=c")
    QTest.keyClick(bar.parameters, Key.Key_Return)
    at.person.until(lambda: "SB1/9" in bar.refusal)
    bar.parameters.setText("fact=SB1/0 value=c")
    QTest.keyClick(bar.parameters, Key.Key_Return)
    at.until_cells(*fact, value="c")
    assert bar.refusal == ""
    assert bar.words.startswith("Injected: set, at ")


def test_a_row_has_a_menu_of_what_can_go_wrong(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    page, fact = at.open(), ("SB1", "1")
    at.until_cells(*fact, value="a")
    at.go_to(*fact)
    QTest.keyClick(page.table, Key.Key_Return)
    (menu,) = (menu for menu in page.findChildren(QMenu) if menu.isVisible())
    words = [action.text() for action in menu.actions() if action.text()]
    assert words == ["Stuck", "Drift", "Noise", "Dropout", "Delay", "End all"]
    QTest.keyClick(menu, Key.Key_Down)
    QTest.keyClick(menu, Key.Key_Return)
    at.until_cells(*fact, disturbed="stuck")


def test_an_invalid_value_is_refused_beside_its_field(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    page, fact = at.open(), ("SB1", "0")
    at.until_cells(*fact, value="a")
    at.go_to(*fact)
    at.person.choose(page.bar.kind, "Noise")
    at.person.write(page.bar.parameter, "2")
    assert page.bar.refusal == "Rate of noise is 2.0, not a number from 0 to 1."
    at.person.write(page.bar.parameter, "often")
    assert page.bar.refusal == "Often is no number."
    assert at.row(*fact).cells[9] == ""


def test_the_page_without_a_run_and_after_one(sit: Sit) -> None:
    run = AtRun(sit(SAMPLES / "hanoi-2.json"))
    at = AtMonitor(run)
    page = at.open()
    assert (page.words.text(), page.rows) == ("No run", ())
    assert not page.bar.on.isEnabled()
    at.person.ctrl(Key.Key_M)
    assert not page.isVisible()
    run.as_fast_as_it_goes()
    run.choose(world="table")
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    page = at.open()
    assert page.words.text() == "2 facts: 2 known. The run is over; this is how it ended"
    assert at.row("SB1").cells[1] == "believed in State_cc"
    assert not page.bar.on.isEnabled()


def test_whoever_supervises_has_it_by_the_same_key(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    at.person.ctrl(Key.Key_3)
    at.person.ctrl(Key.Key_M)
    window = at.window
    at.person.until(window.isVisible)
    at.person.until(lambda: any(row.key == ("SB1", "0") for row in window.page.rows))
    QTest.keyClick(window.page.table, Key.Key_Escape)
    assert not window.isVisible()
    assert at.person.window.mode == "supervise"


def test_the_button_at_the_facts_opens_it(sit: Sit) -> None:
    at = AtMonitor(AtRun(sit(SAMPLES / "hanoi-2.json")))
    at.person.click(at.run.pane.monitor_button)
    at.person.until(lambda: at.page.isVisible())


def test_the_window_has_a_stop_of_its_own_while_a_run_exists(sit: Sit) -> None:
    run = AtRun(sit(SAMPLES / "hanoi-2.json", size=(1280, 800)))
    at = AtMonitor(run)
    page = at.open_apart()
    assert not page.stop.isVisible()
    page.close()
    run.person.come_back()
    run.choose(world="table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    page = at.open_apart()
    assert page.stop.isVisible()
    assert page.stop.size() == run.pane.transport.stop.size()
    assert page.phase.text() == "Ready"
    stop = page.stop
    assert page.rect().contains(stop.geometry())
    page.resize(page.minimumSizeHint())
    assert page.rect().contains(stop.geometry())
    run.person.click(stop)
    run.until_phase("Stopped")
    assert page.phase.text().endswith("Stopped")
    assert stop.isVisible()
    run.pane.run.end()
    run.person.until(lambda: not stop.isVisible())


def test_stop_stays_in_view_over_the_page(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    page = at.open()
    assert page.isVisible()
    assert at.run.pane.transport.stop.isVisible()
    at.person.press(Key.Key_F8)
    at.run.until_phase("Stopped")


def test_a_click_on_a_chip_leads_to_the_row_of_the_fact(sit: Sit) -> None:
    at = _by_hand(sit, SAMPLES / "hanoi-2.json")
    facts = at.run.pane.facts
    at.person.until(lambda: any(row.key == ("SB1", 1) for row in facts.facts.rows))
    row = next(n for n, row in enumerate(facts.facts.rows) if row.key == ("SB1", 1))
    chip = facts.visualRect(facts.facts.index(row, 2)).center()
    QTest.mouseClick(facts.viewport(), Qt.MouseButton.LeftButton, pos=chip)
    at.person.until(at.page.isVisible)
    chosen = at.page.table.chosen
    assert chosen is not None
    assert chosen.key == ("SB1", "1")


def test_the_key_that_opens_the_page_leaves_it(sit: Sit) -> None:
    at = AtMonitor(AtRun(sit(SAMPLES / "hanoi-2.json")))
    page = at.open()
    at.person.ctrl(Key.Key_M)
    assert not page.isVisible()
    assert at.run.pane.isVisible()
    at.person.ctrl(Key.Key_1)
    at.open()
    assert at.person.window.mode == "run"


def test_the_key_that_opens_the_window_closes_it(sit: Sit) -> None:
    at = AtMonitor(AtRun(sit(SAMPLES / "hanoi-2.json")))
    at.person.ctrl(Key.Key_3)
    at.person.ctrl(Key.Key_M)
    page = at.window
    at.person.until(page.isActiveWindow)
    at.person.ctrl(Key.Key_M)
    assert not page.isVisible()
    at.person.come_back()
    # Behind the window it is brought to the front first.
    at.person.ctrl(Key.Key_M)
    at.person.until(page.isVisible)
    at.person.come_back()
    at.person.ctrl(Key.Key_M)
    at.person.until(page.isActiveWindow)
    assert page.isVisible()
