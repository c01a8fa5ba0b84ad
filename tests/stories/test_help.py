"""Help inside the window: F1 on what has the focus, the index, search, links, and the way back."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QPoint, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication, QTextFragment
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio import studio
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.features.help.help_window import HelpWindow
from smsl_studio.studio.features.help.look import blocks, fragments
from smsl_studio.studio.features.help.page_view import ABOVE, PageView
from smsl_studio.studio.features.help.pages import HelpPlace, pages
from smsl_studio.studio.features.help.topics import MODES, PARTS, place_about
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key, Modifier = Qt.Key, Qt.KeyboardModifier
HANOI = SAMPLES / "hanoi.json"


@pytest.fixture
def view(qtbot: QtBot) -> PageView:
    made = PageView(LIGHT)
    qtbot.addWidget(made)
    made.resize(800, 700)
    made.show()
    return made


def shown(person: Person) -> HelpWindow:
    (found,) = (one for one in person.window.features.help.windows if one.isVisible())
    person.until(found.isActiveWindow)
    return found


def helped(person: Person) -> HelpWindow:
    """Press F1 and wait for the help."""
    person.press(Key.Key_F1)
    return shown(person)


def top_line(help_: HelpWindow) -> str:
    """The heading, paragraph or cell at the top of the page, or lower on the last screen."""
    page = help_.page
    bar, cursor = page.verticalScrollBar(), page.textCursor()
    top = page.cursorRect(cursor).top()
    assert 0 <= top <= ABOVE + 10 or (bar.value() == bar.maximum() and top < page.height())
    assert page.cursorForPosition(QPoint(60, top + 4)).block() == cursor.block()
    return cursor.block().text()


def press(
    widget: QWidget, key: Qt.Key, modifier: Qt.KeyboardModifier = Modifier.NoModifier
) -> None:
    QTest.keyClick(widget, key, modifier)


def follow(help_: HelpWindow, words: str) -> None:
    """Click a link of the page."""
    cursor = help_.page.document().find(words)
    assert cursor.charFormat().isAnchor(), words
    cursor.setPosition(cursor.selectionStart() + 1)
    help_.page.setTextCursor(cursor)
    QApplication.processEvents()
    at = help_.page.cursorRect(cursor).center()
    QTest.mouseMove(help_.page.viewport(), at)
    QTest.mouseClick(help_.page.viewport(), LEFT, pos=at)


def pictures_of(help_: HelpWindow) -> list[QTextFragment]:
    pieces = (one for block in blocks(help_.page.document()) for one in fragments(block))
    return [one for one in pieces if one.charFormat().isImageFormat()]


def all_kinds(kind: type) -> Iterator[type]:
    one: type
    for one in kind.__subclasses__():
        yield one
        yield from all_kinds(one)


def focused(window: Window, part: str) -> QWidget:
    found = {
        "canvas": window.canvas,
        "outline": window.outline.tree,
        "library": window.library,
        "properties": window.properties,
        "source": window.source.editor,
    }
    return found[part]


@pytest.mark.parametrize(
    ("part", "place", "line"),
    [
        ("canvas", HelpPlace("window.md", PARTS["Canvas"].anchor, "Canvas"), "Canvas"),
        ("outline", HelpPlace("window.md", PARTS["Findings"].anchor, "Outline"), "Outline"),
        ("properties", HelpPlace("window.md", "forms"), "Forms"),
        ("source", HelpPlace("window.md", "the-source"), "The source"),
    ],
)
def test_f1_explains_what_has_the_focus(sit: Sit, part: str, place: HelpPlace, line: str) -> None:
    person = sit(HANOI)
    focused(person.window, part).setFocus()
    help_ = helped(person)
    assert help_.page.place == place
    assert top_line(help_) == line
    assert help_.page.hasFocus()
    press(help_, Key.Key_Escape)
    assert not help_.isVisible()


def test_f1_on_a_finding_explains_its_rule(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    person.press(Key.Key_F3)
    person.window.findings.list.setFocus()
    help_ = helped(person)
    assert help_.page.place == HelpPlace("inspection.md", "", "R15")
    assert top_line(help_).startswith("R15, E: a mislabelled operation.")


@pytest.mark.parametrize(
    ("key", "title"),
    [(None, "The start page"), (Key.Key_2, "4 Run it"), (Key.Key_3, "Supervise")],
)
def test_f1_explains_the_mode_where_nothing_else_has_the_focus(
    sit: Sit, key: Qt.Key | None, title: str
) -> None:
    person = sit(begin=False)
    if key is not None:
        person.ctrl(key)
        person.window.setFocus()
    assert top_line(helped(person)) == title


def test_f1_works_in_a_dialog_that_waits_and_helps_over_it(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.actions_table["export_picture"].trigger()
    dialog = next(one for one in person.window.findChildren(QDialog) if one.isVisible())
    person.until(dialog.isActiveWindow)
    focus = QApplication.focusWidget()
    assert focus is not None
    press(focus, Key.Key_F1)
    help_ = shown(person)
    assert help_.parent() is dialog, "else the dialog would block it"
    assert help_.page.place == PARTS["PictureDialog"]
    press(help_, Key.Key_Escape)
    dialog.reject()
    person.come_back()


def test_a_link_leads_to_its_page_and_section(sit: Sit) -> None:
    help_ = helped(sit(HANOI))
    help_.page.show_place(HelpPlace("window.md", "keys"))
    follow(help_, "find in the drawing")
    assert help_.page.place == HelpPlace("window.md", "finding")
    assert top_line(help_) == "Finding"
    help_.page.show_place(HelpPlace("window.md", "keys"))
    follow(help_, "monitor page")
    assert help_.page.place == HelpPlace("monitoring.md", "the-monitor-page")


def test_search_finds_sections_of_all_pages(sit: Sit) -> None:
    person = sit(HANOI)
    help_ = helped(person)
    press(help_, Key.Key_F, Modifier.ControlModifier)
    assert help_.field.hasFocus()
    QTest.keyClicks(help_.field, "PRUNE reason")
    assert help_.hits.isVisible()
    texts = [help_.hits.item(at).text() for at in range(help_.hits.count())]
    assert len(texts) > 3
    assert all("\n" in text for text in texts)
    assert help_.count.text() == f"{len(texts)} sections"
    press(help_.field, Key.Key_Return)
    place = help_.page.place
    assert place is not None
    marked = {one.cursor.selectedText().lower() for one in help_.page.extraSelections()}
    assert marked == {"prune", "reason"}
    press(help_.field, Key.Key_Down)
    press(help_.hits, Key.Key_Down)
    press(help_.hits, Key.Key_Return)
    assert help_.page.place not in (None, place)
    QTest.keyClicks(help_.field, " zzz")
    assert help_.count.text() == "No page has “PRUNE reason zzz”."
    press(help_.field, Key.Key_Escape)
    assert help_.index.isVisible()
    assert help_.isVisible(), "the first Esc clears the field"


def test_the_index_leads_to_every_page_and_section(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.actions_table["help_pages"].trigger()
    help_ = shown(person)
    assert help_.page.place == HelpPlace("engineer.md")
    for page in pages():
        for section in page.sections:
            place = HelpPlace(page.name, section.anchor)
            help_.page.show_place(place)
            begun = help_.page.textCursor().block()
            assert begun.text() == section.title.replace("`", ""), place
            assert begun.blockFormat().headingLevel() == section.level
    item = help_.index.currentItem()
    assert item is not None
    assert item.text(0) == "Benches"
    group = help_.index.topLevelItem(1)
    assert group is not None
    page_item = group.child(0)
    assert page_item is not None
    help_.index.setFocus()
    help_.index.setCurrentItem(page_item)
    press(help_.index, Key.Key_Return)
    assert help_.page.place == HelpPlace("window.md")


def test_back_and_forward_return_to_where_one_read(sit: Sit) -> None:
    person = sit(HANOI)
    help_ = helped(person)
    first, bar = help_.page.place, help_.page.verticalScrollBar()
    bar.setValue(bar.value() + 333)
    left = bar.value()
    assert not help_.back.isEnabled()
    help_.page.show_place(HelpPlace("people.md", "levels"))
    press(help_, Key.Key_Left, Modifier.AltModifier)
    assert (help_.page.place, bar.value()) == (first, left)
    press(help_, Key.Key_Right, Modifier.AltModifier)
    assert help_.page.place == HelpPlace("people.md", "levels")
    assert not help_.on.isEnabled()
    person.click(help_.back)
    assert help_.page.place == first


def test_a_link_that_leads_out_is_shown_and_never_followed_by_itself(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: asked.append(url.toString()))
    person = sit(HANOI)
    help_ = helped(person)
    help_.page.show_place(HelpPlace("architecture.md", "the-checkout"))
    follow(help_, "uv")
    assert help_.bar.isVisible()
    assert help_.page.place == HelpPlace("architecture.md", "the-checkout")
    assert asked == []
    person.click(help_.copies)
    assert QGuiApplication.clipboard().text() == "https://docs.astral.sh/uv/"
    person.click(help_.opens)
    assert asked == ["https://docs.astral.sh/uv/"]
    assert not help_.bar.isVisible()


@pytest.mark.parametrize(
    ("page", "link", "place"),
    [
        ("window.md", "#forms", HelpPlace("window.md", "forms")),
        ("window.md", "language.md#saving", HelpPlace("language.md", "saving")),
        ("decisions/README.md", "../running.md", HelpPlace("running.md")),
        ("architecture.md", "decisions/README.md", HelpPlace("decisions/README.md")),
        ("window.md", "../CONTRIBUTING.md", None),
        ("window.md", "../../../etc/passwd", None),
        ("window.md", "file:///etc/passwd", None),
        ("window.md", "https://example.org/window.md", None),
    ],
)
def test_where_a_link_leads(view: PageView, page: str, link: str, place: HelpPlace | None) -> None:
    view.show_place(HelpPlace(page))
    assert view.target(QUrl(link)) == place


def test_pictures_are_shown_and_never_wider_than_the_page(sit: Sit) -> None:
    help_ = helped(sit(HANOI))
    help_.page.show_place(HelpPlace("window.md"))
    for wide in (1120, 760):
        help_.resize(wide, 700)
        QApplication.processEvents()
        widths = [one.charFormat().toImageFormat().width() for one in pictures_of(help_)]
        assert len(widths) > 3
        assert all(300 < width < help_.page.viewport().width() for width in widths)


def test_the_pages_follow_the_theme(sit: Sit) -> None:
    person = sit(HANOI)
    help_ = helped(person)
    place, scroll = help_.page.place, help_.page.verticalScrollBar().value()
    person.windows.set_theme("dark")
    picture = help_.page.grab().toImage()
    assert picture.pixelColor(4, 4).name() == DARK.surf.name()
    colour = help_.page.textCursor().block().begin().fragment().charFormat().foreground().color()
    assert colour.name() == DARK.tx.name()
    assert (help_.page.place, help_.page.verticalScrollBar().value()) == (place, scroll)


def test_every_mode_panel_and_dialog_has_a_row_that_leads_to_a_section(sit: Sit) -> None:
    for module in pkgutil.walk_packages(studio.__path__, "smsl_studio.studio."):
        importlib.import_module(module.name)
    window = sit(HANOI).window
    kinds = {kind.__name__: kind for kind in all_kinds(QWidget)}
    assert [name for name in PARTS if name not in kinds] == [], "no such class"
    modes = {mode for feature in window.features for mode in feature.pages}
    assert set(MODES) == modes
    panels = [place_about(one.widget, "draw") for one in window.docks.panels]
    ours = [kind for kind in all_kinds(QDialog) if kind.__module__.startswith("smsl_studio")]
    assert len(ours) > 5
    assert [k.__name__ for k in ours if not PARTS.keys() & {b.__name__ for b in k.__mro__}] == []
    sections = {(page.name, one.anchor) for page in pages() for one in page.sections}
    for place in (*MODES.values(), *PARTS.values(), *panels):
        assert (place.page, place.anchor) in sections, place


def test_every_word_of_a_row_begins_a_paragraph(view: PageView, sit: Sit) -> None:
    panels = [place_about(one.widget, "draw") for one in sit(HANOI).window.docks.panels]
    assert MODES["draw"] not in panels
    for place in {place for place in (*PARTS.values(), *panels) if place.word}:
        view.show_place(place)
        assert view.textCursor().block().text().startswith(place.word), place


def test_every_paragraph_of_every_page_has_its_lines(view: PageView) -> None:
    for page in pages():
        view.show_place(HelpPlace(page.name))
        view.document().size()
        empty = [one.text() for one in blocks(view.document()) if not one.layout().lineCount()]
        assert empty == [], page.name
