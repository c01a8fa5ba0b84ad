"""The canvas as a view: levels of detail, marks, floating parts, and text for assistive tools."""

from __future__ import annotations

import dataclasses
import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAccessible, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import change_notes
from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.levels import Level, Spacing, level_at, spacing_of, unit_at
from smsl_studio.picture.marks import Marks
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.canvas.accessible import state_words
from smsl_studio.studio.base.canvas.node_item import NodeItem
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.shell import accessible_factory
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import read
from tests.plugin_folder import blueprint_of
from tests.stories.at_canvas import Drawer, sample

ROOMY = Spacing()
ROOT = Path(__file__).resolve().parents[4]


@pytest.fixture
def hfsm(qtbot: QtBot) -> Drawer:
    return Drawer(qtbot, sample("hfsm.json"))


@pytest.fixture
def hanoi3(qtbot: QtBot) -> Drawer:
    return Drawer(qtbot, sample("hanoi-corrected.json"))


def picture(drawer: Drawer) -> QImage:
    return drawer.canvas.viewport().grab().toImage()


def on_screen(drawer: Drawer) -> QImage:
    """What stands on the screen when the zoom is at rest, without painting it again."""
    while not drawer.canvas.camera.is_at_rest:
        QApplication.processEvents()
    for _ in range(3):
        QApplication.processEvents()
    return QApplication.primaryScreen().grabWindow(drawer.canvas.winId()).toImage()


def painted_anew(drawer: Drawer) -> QImage:
    """What stands on the screen after all of it was painted again, the kept background too."""
    drawer.canvas.resetCachedContent()
    drawer.canvas.viewport().update()
    return on_screen(drawer)


def alike(a: QImage, b: QImage) -> bool:
    """Whether two pictures are one but for the rounding of a clipped line's colours."""
    first, second = (
        np.frombuffer(bytes(image.constBits()), np.uint8).astype(int) for image in (a, b)
    )
    return bool(np.abs(first - second).max() <= 3)


@pytest.mark.parametrize(
    ("zoom", "level"),
    [(0.1, Level.DOT), (0.2, Level.BOX), (0.5, Level.COMPACT), (0.7, Level.FULL), (2, Level.FULL)],
)
def test_the_level_follows_the_zoom(zoom: float, level: Level) -> None:
    assert level_at(zoom, ROOMY) is level


def test_a_dense_layout_is_shown_coarser_and_never_full() -> None:
    at = np.array([(x * 60.0, y * 40.0) for x in range(6) for y in range(6)])
    spacing = spacing_of(at, np.full(36, 108.0), np.full(36, 46.0))
    assert not spacing.roomy
    assert level_at(1.0, spacing) is Level.COMPACT
    assert level_at(0.5, spacing) < Level.COMPACT
    assert spacing.pitch == pytest.approx(40.0)


def test_one_state_among_several_others_takes_the_room_of_itself_alone() -> None:
    at = np.array([(400.0 * (n % 4), 300.0 * (n // 4)) for n in range(12)])
    widths = np.full(12, 200.0)
    assert spacing_of(at, widths, widths).roomy
    at[0] = (600.0, 300.0)
    at[1], at[2], at[5], at[6] = (500.0, 270.0), (700.0, 270.0), (480.0, 350.0), (720.0, 350.0)
    assert spacing_of(at, widths, widths).roomy
    at[4], at[7] = (480.0, 300.0), (720.0, 300.0)
    assert not spacing_of(at, widths, widths).roomy, "they are near to each other, too"


def test_marks_keep_their_size_on_the_screen_below_full() -> None:
    assert unit_at(0.5, Level.COMPACT) == 2.0
    assert unit_at(0.8, Level.FULL) == 1.0
    assert unit_at(3.0, Level.COMPACT) == 1.0


def test_hanoi_is_compact_and_a_small_procedure_is_full(hanoi3: Drawer, hfsm: Drawer) -> None:
    assert hanoi3.sheet.level is Level.COMPACT
    assert hfsm.sheet.level is Level.FULL
    assert hanoi3.canvas.overlays.key.rows == (
        ("aaa", "short for State_aaa"),
        ("1b", "short for Op_1b"),
    )


def test_many_states_share_a_small_pool_of_items(qtbot: QtBot) -> None:
    drawer = Drawer(qtbot, hanoi(6))
    drawer.canvas.fit()
    assert drawer.sheet.level is Level.DOT
    assert not drawer.canvas.pool.used
    middle = drawer.sheet.at[len(drawer.sheet.at) // 2]
    drawer.canvas.camera.go(QPointF(*middle), 1.0)
    near = set(drawer.canvas.pool.used)
    assert 0 < len(near) < 80
    drawer.canvas.camera.pan(-600, 0)
    assert set(drawer.canvas.pool.used) != near
    drawer.canvas.fit()
    drawer.canvas.set_marks(Marks(active=drawer.sheet.picture.names[0]))
    assert set(drawer.canvas.pool.used) == {0}, "what is lit never falls below compact"


def test_a_highlight_keeps_scene_and_geometry(hanoi3: Drawer) -> None:
    sheet, geometry = hanoi3.sheet, hanoi3.sheet.geometry
    before = picture(hanoi3)
    hanoi3.canvas.set_marks(Marks(active="State_bba", visited=frozenset({"State_aaa"})))
    QApplication.processEvents()
    assert hanoi3.sheet is sheet
    assert sheet.geometry is geometry
    assert picture(hanoi3) != before
    hanoi3.canvas.set_marks(Marks())
    QApplication.processEvents()
    assert picture(hanoi3) == before


@pytest.mark.parametrize(
    "marks",
    [
        Marks(active="State100"),
        Marks(visited=frozenset({"State100"})),
        Marks(next_states=frozenset({"State100"})),
        Marks(goals=frozenset({"State111"})),
        Marks(selection=(Address("SB1", "State100"),)),
        Marks(selection=(Address("SB1", "State100", "Operation100A"),)),
        Marks(running=(Address("SB1", "State100", "Operation100A"), 0.4), running_words="2 s"),
        Marks(running=(Address("SB1", "State100", "Operation100A"), None)),
        Marks(trail=(Address("SB1", "State100", "Operation100A"),)),
        Marks(planned=(Address("SB1", "State100", "Operation100A"),)),
        Marks(pruned=frozenset({Address("SB1", "State100", "Operation100A")})),
        Marks(risky=frozenset({Address("SB1", "State100", "Operation100A")})),
        Marks(held_back=frozenset({Address("SB1", "State100", "Operation100A")})),
        Marks(findings={Address("SB1", "State100"): "E"}),
        Marks(findings={Address("SB1", "State100", "Operation100A"): "W"}),
        Marks(facts={("State100", 0): "agrees"}),
        Marks(facts={("State100", 0): "differs"}),
        Marks(facts={("State100", 1): "unknown"}),
        Marks(facts={("State100", 2): "transit"}),
        Marks(dimmed=True),
    ],
)
def test_every_mark_is_seen_in_both_themes_and_goes_again(hfsm: Drawer, marks: Marks) -> None:
    for tokens in (hfsm.canvas.tokens, DARK):
        hfsm.canvas.set_tokens(tokens)
        QApplication.processEvents()
        plain = picture(hfsm)
        hfsm.canvas.set_marks(marks)
        QApplication.processEvents()
        assert picture(hfsm) != plain
        hfsm.canvas.set_marks(Marks())
        QApplication.processEvents()
        assert picture(hfsm) == plain


def test_marks_of_elements_that_are_not_shown_are_ignored(hfsm: Drawer) -> None:
    hfsm.canvas.set_marks(
        Marks(
            active="State_gone",
            trail=(Address("SB2", "State0", "Operation0"), Address("SB1", "No", "Op")),
            findings={Address("SB9"): "E"},
        )
    )
    assert hfsm.sheet.looks.lit_states == []
    assert hfsm.sheet.looks.lit_edges == []


def test_assistive_tools_hear_every_state(hfsm: Drawer, qapp: QApplication) -> None:
    accessible_factory.install(qapp)
    hfsm.canvas.set_marks(dataclasses.replace(Marks(), active="State100"))
    found = QAccessible.queryAccessibleInterface(hfsm.canvas)
    assert found.childCount() == 4
    words = [found.child(i).text(QAccessible.Text.Name) for i in range(4)]
    assert words == [
        "State000, initial, 1 operation out",
        "State100, active, 2 operations out",
        "State110, 2 operations out",
        "State111, activating, 0 operations out",
    ]
    place = hfsm.hands_on.mapToGlobal(hfsm.place("State110"))
    assert found.child(2).rect().contains(place)
    assert found.childAt(place.x(), place.y()).text(QAccessible.Text.Name) == words[2]
    hfsm.click(hfsm.place("State110"))
    assert hfsm.canvas.accessibleDescription() == "State110, selected, 2 operations out"


def test_assistive_tools_hear_loops_apart(qtbot: QtBot) -> None:
    """A loop leads to no other state."""
    table = {"State0": {"go": "State1", "stay": "State0"}, "State1": {"a": "State1", "b": "State1"}}
    drawer = Drawer(qtbot, blueprint_of({"SB1": table}))
    words = [state_words(drawer.canvas, at) for at in (0, 1)]
    assert words[0].endswith(", 1 operation out, 1 loop")
    assert words[1].endswith(", 0 operations out, 2 loops")


def test_a_banner_is_shown_and_taken_away(hfsm: Drawer) -> None:
    hfsm.canvas.show_banner("The drawing has moved on")
    banner = hfsm.canvas.overlays.banner
    assert banner.isVisible()
    assert banner.text == "The drawing has moved on"
    hfsm.canvas.show_banner("")
    assert not banner.isVisible()


def test_an_empty_canvas_offers_a_sample(qtbot: QtBot) -> None:
    drawer = Drawer(qtbot)
    hint = drawer.canvas.overlays.empty
    with qtbot.waitSignal(hint.sample_wanted):
        QTest.mouseClick(hint.sample, Qt.MouseButton.LeftButton)


def test_the_legend_explains_only_marks_that_occur(hfsm: Drawer) -> None:
    legend = hfsm.canvas.overlays.legend
    assert legend.isVisible()
    assert "turns it off" in legend.accessibleName()
    hfsm.session.show_branch("SB2")
    assert not legend.isVisible()


def test_the_mini_map_goes_where_it_is_pressed(hanoi3: Drawer) -> None:
    hanoi3.canvas.zoom_to(2.0)
    map_ = hanoi3.canvas.overlays.map
    assert map_.isVisible()
    before = hanoi3.canvas.camera.centre
    QTest.mouseClick(
        map_, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(74, 20)
    )
    assert hanoi3.canvas.camera.centre.y() < before.y() - 50


def test_the_hover_pad_stands_beside_a_state_and_renames_it(hfsm: Drawer, qtbot: QtBot) -> None:
    hfsm.hover(hfsm.place("State110"))
    pad = hfsm.canvas.overlays.pad
    qtbot.waitUntil(lambda: pad.address == Address("SB1", "State110"))
    rect = hfsm.canvas.rect_of(Address("SB1", "State110"))
    assert rect is not None
    assert not hfsm.canvas.mapFromScene(rect).boundingRect().intersects(pad.geometry())
    QTest.mouseClick(pad.rename, Qt.MouseButton.LeftButton)
    hfsm.write("State011")
    assert "State011" in hfsm.table()


def test_the_hover_pad_connects_by_the_next_click(hfsm: Drawer, qtbot: QtBot) -> None:
    hfsm.hover(hfsm.place("State111"))
    pad = hfsm.canvas.overlays.pad
    qtbot.waitUntil(lambda: pad.address is not None)
    QTest.mouseClick(pad.connect_to, Qt.MouseButton.LeftButton)
    hfsm.click(hfsm.place("State000"))
    hfsm.write("Restart")
    assert hfsm.table()["State111"] == {"Restart": "State000"}


def test_only_what_changed_is_painted_and_nothing_stale_stays(hanoi3: Drawer) -> None:
    """A run seen tick by tick looks at every tick as if it were painted whole."""
    route = [("State_aaa", "Op_1c"), ("State_caa", "Op_2b"), ("State_cba", "Op_1b")]
    for state, operation in route:
        for share in (0.0, 0.4, 0.9):
            address = Address("SB1", state, operation)
            words = f"{share:.1f} of 1.0 s"
            hanoi3.canvas.set_marks(
                Marks(active=state, running=(address, share), running_words=words, dimmed=True)
            )
            QApplication.processEvents()
            seen = on_screen(hanoi3)
            assert alike(painted_anew(hanoi3), seen)
            rect = hanoi3.canvas.lit_layer.shown()[hanoi3.sheet.picture.edge(address)].rect
            view = hanoi3.canvas.lit_layer.view
            assert view[0] <= rect[0]
            assert rect[2] <= view[2]


def test_reveal_brings_a_state_into_view(hanoi3: Drawer) -> None:
    hanoi3.canvas.zoom_to(4.0)
    address = Address("SB1", "State_ccc")
    hanoi3.canvas.reveal(address)
    assert hanoi3.hands_on.rect().contains(hanoi3.place("State_ccc"))


def test_a_canvas_that_grows_fits_again_until_somebody_looked_elsewhere(hanoi3: Drawer) -> None:
    zoom = hanoi3.canvas.zoom
    hanoi3.canvas.resize(700, 500)
    QApplication.processEvents()
    assert hanoi3.canvas.zoom < zoom
    hanoi3.canvas.zoom_to(1.5)
    hanoi3.canvas.resize(900, 600)
    QApplication.processEvents()
    assert hanoi3.canvas.zoom == 1.5


def test_gestures_leave_nothing_stale_on_the_screen(hfsm: Drawer) -> None:
    def same_when_painted_whole(what: str) -> None:
        QApplication.processEvents()
        seen = on_screen(hfsm)
        assert alike(painted_anew(hfsm), seen), what

    # Its buttons come by themselves, perhaps between two looks.
    hfsm.canvas.overlays.pad.setMaximumSize(0, 0)
    hands, left = hfsm.hands_on, Qt.MouseButton.LeftButton
    none = Qt.KeyboardModifier.NoModifier
    hfsm.hover(hfsm.place("State100"))
    same_when_painted_whole("hover a state")
    hfsm.hover(hfsm.label_of("State100", "Operation100B"))
    same_when_painted_whole("hover an operation")
    hfsm.click(hfsm.label_of("State100", "Operation100B"))
    same_when_painted_whole("select an operation")
    hfsm.click(hfsm.place("State110"))
    same_when_painted_whole("select a state")
    start = hfsm.place("State110")
    hfsm.press(start)
    for step in range(10, 120, 30):
        QTest.mouseMove(hands, start + QPoint(step, -step))
        same_when_painted_whole("drag a state")
    for name in ("State000", "State111"):
        QTest.mouseMove(hands, hfsm.place(name) + QPoint(0, 130))
        assert hfsm.canvas.gestures.guides
        same_when_painted_whole("guides")
    QTest.mouseMove(hands, start + QPoint(100, -100))
    same_when_painted_whole("guides go")
    QTest.mouseRelease(hands, left, none, start + QPoint(100, -100))
    same_when_painted_whole("let it go")
    hfsm.session.history.undo()
    same_when_painted_whole("undo")
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Up):
        hfsm.key(key)
        same_when_painted_whole("move by a key")
    hfsm.click(QPoint(20, 600))
    same_when_painted_whole("select nothing")
    hfsm.press(QPoint(40, 200))
    for x, y in ((200, 300), (600, 550), (300, 250)):
        QTest.mouseMove(hands, QPoint(x, y))
        same_when_painted_whole("rubber band")
    QTest.mouseRelease(hands, left, none, QPoint(300, 250))
    same_when_painted_whole("end of the band")
    handle = hfsm.handle_of("State111", "bottom")
    hfsm.hover(handle)
    same_when_painted_whole("handle")
    hfsm.press(handle)
    for x, y in ((700, 600), (300, 600), (560, 240), (620, 330)):
        QTest.mouseMove(hands, QPoint(x, y))
        same_when_painted_whole("draw an operation")
    hfsm.key(Qt.Key.Key_Escape)
    QTest.mouseRelease(hands, left, none, QPoint(620, 330))
    same_when_painted_whole("leave it")
    hfsm.canvas.camera.pan(-37, 21)
    same_when_painted_whole("pan")
    hfsm.canvas.camera.zoom_at(1.3, QPointF(300, 300))
    same_when_painted_whole("zoom")


@pytest.mark.parametrize("seed", range(4))
def test_edits_leave_nothing_stale_on_the_screen(hanoi3: Drawer, seed: int) -> None:
    """Moves, edits, undo, other colours and another zoom, in any order."""
    session, canvas, chance = hanoi3.session, hanoi3.canvas, random.Random(seed)

    def drag() -> None:
        start = hanoi3.place(chance.choice([*canvas.positions]))
        hanoi3.drag(start, start + QPoint(chance.randint(-200, 200), chance.randint(-200, 200)))

    def delete() -> None:
        hanoi3.click(hanoi3.place(chance.choice([*canvas.positions])))
        hanoi3.key(Qt.Key.Key_Delete)

    def zoom() -> None:
        canvas.camera.zoom_at(chance.choice([0.8, 1.25]), QPointF(300, 300))

    steps = [drag, drag, delete, zoom, session.history.undo, session.history.redo]
    steps += [lambda: canvas.set_tokens(chance.choice([LIGHT, DARK]))]
    for _ in range(25):
        step = chance.choice(steps)
        step()
        seen = on_screen(hanoi3)
        assert alike(painted_anew(hanoi3), seen), step


@pytest.mark.parametrize("scale", ["1.25", "1.5", "2"])
def test_a_pan_leaves_nothing_behind_at_any_scale_of_the_screen(scale: str) -> None:
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "tests.studio.base.canvas.scrolled",
            str(samples_dir() / "hfsm.json"),
        ],
        env={**os.environ, "QT_SCALE_FACTOR": scale},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.splitlines()[-1]) <= 3


def test_states_that_are_not_near_have_no_item(qtbot: QtBot) -> None:
    drawer = Drawer(qtbot, sample("hfsm.json"))
    drawer.canvas.show_branch(read(BY_NAME["states_in_a_ring"], "json", 60_000), "B")
    assert drawer.canvas.sheet is not None
    assert len(drawer.canvas.sheet.picture) > 1_000
    drawer.canvas.fit()
    assert drawer.canvas.sheet.level is Level.DOT
    items = [one for one in drawer.canvas.scene().items() if isinstance(one, NodeItem)]
    assert len(items) <= 50


def test_what_is_not_lit_is_painted_once(hanoi3: Drawer, monkeypatch: pytest.MonkeyPatch) -> None:
    canvas, painted = hanoi3.canvas, []
    on_screen(hanoi3)
    monkeypatch.setattr(canvas.ground.edges, "paint", lambda *given: painted.append(given[-1]))
    canvas.viewport().repaint()
    assert painted == [], "nothing has changed"
    chosen = Address("SB1", "State_aaa")
    canvas.set_marks(Marks(selection=(chosen,)))
    on_screen(hanoi3)
    assert painted, "the operations out of it are lit now"
    seen = canvas.seen
    assert all(area.width() < seen.width() / 2 for area in painted), "only where they run"


def test_words_instead_of_digits_leave_nothing_stale_on_the_screen(hfsm: Drawer) -> None:
    canvas, session = hfsm.canvas, hfsm.session
    meant = {("SB1", "0"): {"values": {"0": "open", "1": "fixed for good"}}}
    session.edit("Name values", lambda blueprint: change_notes(blueprint, "_facts", meant))
    digits, text = on_screen(hfsm), session.blueprint.document.text

    def texts() -> list[str]:
        assert canvas.sheet is not None
        return [chip.text for chip in canvas.sheet.picture.face(1).chips]

    canvas.set_words(True)
    assert texts() == ["fixed for…", "Fact 2: 0", "0"]
    words = on_screen(hfsm)
    assert not alike(words, digits)
    assert alike(painted_anew(hfsm), words)
    canvas.set_words(False)
    assert texts() == ["1", "0", "0"]
    assert alike(on_screen(hfsm), digits)
    assert session.blueprint.document.text == text


def test_the_signs_of_a_search_leave_nothing_stale_on_the_screen(hanoi3: Drawer) -> None:
    canvas, picture = hanoi3.canvas, hanoi3.sheet.picture
    states = [Address("SB1", name) for name in picture.names]
    edges = [picture.address(edge) for edge in range(0, len(picture.operations), 3)]
    plain = on_screen(hanoi3)
    for zoom in (1.0, 0.5, 0.2):
        canvas.zoom_to(zoom)
        for found, hit in (
            ((*states, *edges), states[0]),
            (tuple(states[3:9]), states[5]),
            (tuple(edges), edges[2]),
            ((), None),
        ):
            selection = (hit,) if hit is not None else ()
            marks = dataclasses.replace(canvas.marks, found=found, hit=hit, selection=selection)
            before = on_screen(hanoi3)
            canvas.set_marks(marks)
            seen = on_screen(hanoi3)
            assert not alike(before, seen), "the signs are seen"
            assert alike(painted_anew(hanoi3), seen), (zoom, hit)
    canvas.fit()
    assert alike(on_screen(hanoi3), plain)
