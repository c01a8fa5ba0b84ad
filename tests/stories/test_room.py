"""The page Room: a tag for each node, what it says, what is silent, and Stop in view."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from smsl_studio.front.views.room_view import CONTESTED, FRESH, SILENT, STALE, NodeTag, RoomFact
from smsl_studio.studio.features.room.page import RoomPage
from tests.monitor.tls_site import EYE, FORCE, TlsSite, Voice
from tests.stories.at_run import PATIENCE, AtRun
from tests.stories.conftest import Sit


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TlsSite]:
    made = TlsSite(tmp_path_factory.mktemp("ward"))
    text = (made.folder / "site.toml").read_text("utf-8")
    text += (
        '[person.nurse]\ntitle = "Nurse <b>"\nplace = [2.0, 2.0]\nhere = "SB/1 force"\nleast = 7\n'
    )
    text = text.replace('title = "Eye"', 'title = "Eye"\ndraws = "tracker"\nreach = 2.0')
    (made.folder / "site.toml").write_text(text, "utf-8")
    yield made
    made.broker.kill()


@pytest.fixture
def eye(site: TlsSite) -> Iterator[Voice]:
    voice = Voice(site, site.login("eye"), "eye").steady(EYE, "a")
    yield voice
    voice.close()


@pytest.fixture
def clamp(site: TlsSite) -> Iterator[Voice]:
    voice = Voice(site, site.login("clamp"), "clamp").steady(FORCE, 20.0)
    yield voice
    voice.close()


class AtRoom:
    """A run by hand with its page Room before it."""

    def __init__(self, run: AtRun) -> None:
        self.run, self.person = run, run.person
        body = self.person.window.features.run.body
        assert body is not None
        self.pages = body

    @property
    def page(self) -> RoomPage:
        return self.person.window.features.room.page

    def node(self, name: str) -> NodeTag:
        assert self.page.view is not None
        found = self.page.view.node(name)
        assert found is not None
        return found

    def fact(self, key: str) -> RoomFact:
        assert self.page.view is not None
        return next(one for one in self.page.view.facts if one.key == key)

    def until_standing(self, name: str, *standings: str) -> None:
        def there() -> None:
            assert self.node(name).standing in standings

        self.person.qtbot.waitUntil(there, timeout=PATIENCE)


@pytest.fixture
def room(sit: Sit, site: TlsSite, eye: Voice, clamp: Voice) -> AtRoom:
    run = AtRun(sit(site.folder / "sb.json"))
    run.choose(world="table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Qt.Key.Key_F5)
    run.until_phase("Ready")
    at = AtRoom(run)
    assert at.pages.names == ("One run", "Campaign", "Monitor")
    at.pages.show_page("Monitor")
    run.person.click(run.person.window.features.monitor.inside().buttons["Room"])
    at.until_standing("eye", FRESH)
    return at


def test_the_room_shows_who_speaks_and_who_is_silent(room: AtRoom, eye: Voice) -> None:
    page = room.page
    assert "TLS" in page.lock.text()
    assert page.silent.text() == "2 nodes, 0 silent"
    assert room.node("clamp").reads == (("force of SB/1", "20 N"),)
    assert room.fact("SB/1").predicates == (("0", "force < 5 N"), ("1", "force > 10 N"))
    assert page.view is not None
    assert [one.words for one in page.view.persons] == ["not sterile"]

    eye.hush()
    room.until_standing("eye", STALE)
    room.until_standing("eye", SILENT)
    assert room.fact("SB/0").value is None
    assert room.fact("SB/0").rests_on.startswith("Eye s")
    assert room.node("clamp").standing == FRESH

    room.person.click(page.kinds["device"])
    assert [one.name for one in page.plan.tags] == ["eye"], "a silent node is always shown"
    room.person.click(page.kinds["device"])
    eye.steady(EYE, "a")
    room.until_standing("eye", FRESH)

    plan = room.page.plan
    place = plan.tag_place("clamp").center()
    QTest.mouseClick(plan, Qt.MouseButton.LeftButton, pos=QPoint(int(place.x()), int(place.y())))
    assert plan.node == "clamp"
    assert room.page.side.title.text() == "Clamp"
    QTest.keyClick(plan, Qt.Key.Key_Left)
    assert plan.node == "eye"
    assert "Eye: " in plan.accessibleDescription()


def test_a_second_speaker_is_told_and_stop_is_in_view(room: AtRoom, site: TlsSite) -> None:
    thief = Voice(site, site.login("eye"), "eye")
    thief.boot = 400
    thief.steady(EYE, "b")
    room.until_standing("eye", CONTESTED)
    thief.close()
    assert room.fact("SB/0").value is None

    assert room.run.pane.transport.stop.isVisible()
    assert not room.run.pane.isVisible()
    room.person.press(Qt.Key.Key_F8)
    room.run.until_phase("Stopped")
    assert room.page.isVisible()


def test_without_nodes_there_is_no_such_page(sit: Sit, tmp_path: Path) -> None:
    from tests.stories.person import SAMPLES

    run = AtRun(sit(SAMPLES / "hanoi-2.json"))
    run.choose(world="table")
    run.person.press(Qt.Key.Key_F5)
    run.person.ctrl(Qt.Key.Key_M)
    pages = run.person.window.features.monitor.inside()
    run.person.until(pages.sensors.isVisible)
    assert not pages.switch.isVisible()
