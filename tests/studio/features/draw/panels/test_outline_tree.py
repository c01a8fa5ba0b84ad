"""The tree of the outline: no work for hidden lines, and edits keep it expanded as it is."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import parse_bytes
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.draw.panels.outline_tree import FULL, OutlineTree, line_of
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import steps
from tests.stories.at_outline import shown, texts

Make = Callable[[Blueprint], OutlineTree]


@pytest.fixture
def make(qtbot: QtBot) -> Make:
    panel = QWidget()
    qtbot.addWidget(panel)

    def made(blueprint: Blueprint) -> OutlineTree:
        return OutlineTree(LIGHT, blueprint, panel)

    return made


def bomb(name: str, count: int) -> Blueprint:
    return read_blueprint(parse_bytes(BY_NAME[name].make("json", count).encode(), "large.json"))


def read(text: str, file: str = "small.json") -> Blueprint:
    return read_blueprint(parse_bytes(text.encode(), file))


SMALL = """{"A": {"HEADER": {"SUB_SBS": {"B": 1}}, "S_00": {"o": "S_11"}, "S_11": {}},
  "B": {"T_0": {"o": "T_1"}, "T_1": {}}, "C": {"U_0": {}}}"""
OPEN = ["A", "Fact 1", "Fact 2", "B", "Fact 1", "C", "Fact 1"]


def test_a_small_blueprint_stands_open(make: Make) -> None:
    assert texts(make(read(SMALL))) == OPEN


def test_a_line_says_its_level_and_what_stands_above_it(make: Make) -> None:
    """A screen reader reads the lines one below the other."""
    tree = make(read(SMALL))
    tree.show_marks({"B": "W"})
    said = [index.data(Qt.ItemDataRole.AccessibleTextRole) for index in shown(tree)]
    assert said == [
        "A, State Branch, level 0",
        "Fact 1, digit 0 of A",
        "Fact 2, digit 1 of A, expanded by B",
        "B, State Branch, level 1, below Fact 2 of A, warning",
        "Fact 1, digit 0 of B",
        "C, State Branch, level 0",
        "Fact 1, digit 0 of C",
    ]


@pytest.mark.parametrize("name", ["sub_cycles", "shared_sub", "sub_diamonds", "small_sbs"])
def test_of_very_many_lines_the_first_stand_open(
    make: Make, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.studio.features.draw.panels.outline_tree.FULL", 60)
    blueprint = bomb(name, 300)
    tree = make(blueprint)
    lines = shown(tree)
    assert [tree.isExpanded(index) for index in lines[:20:4]]
    assert sum(map(tree.isExpanded, lines)) <= 60
    assert len(lines) <= 60 + len(blueprint.branches)
    assert not tree.isExpanded(lines[-1])


@pytest.mark.parametrize("name", ["sub_cycles", "shared_sub", "small_sbs"])
def test_a_line_that_nobody_sees_takes_hardly_any_work(
    make: Make, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.studio.features.draw.panels.outline_tree.FULL", 60)
    less, more = bomb(name, 1_000), bomb(name, 2_000)
    steps(lambda: make(bomb(name, 12)))  # what is made at the first use is no work of ours
    begun = steps(lambda: make(less))
    assert steps(lambda: make(more)) - begun <= 50 * 1_000
    tree = make(more)
    changed = editing.add_state(more, "B5", "S_new") if name == "small_sbs" else more
    assert steps(lambda: tree.show_blueprint(changed, False)) <= 40 * 2_000


def test_a_line_is_found_by_its_sb_and_fact_and_says_what_it_is(make: Make) -> None:
    tree = make(bomb("known_subs", 900))
    found = tree.index_of("A", 700)
    assert line_of(found).tip == "Fact 701, digit 700 of A"
    assert found.data(Qt.ItemDataRole.ToolTipRole) == "Fact 701, digit 700 of A"
    assert line_of(tree.index_of("B899", 0)).branch == "B899"
    assert not tree.index_of("").isValid()
    assert not tree.index_of("B900").isValid()


def test_what_was_closed_stays_closed_where_other_lines_come(make: Make) -> None:
    blueprint = read(SMALL)
    tree = make(blueprint)
    tree.collapse(tree.index_of("A", 1))
    more = editing.add_branch(blueprint, "D")
    tree.show_blueprint(more, False)
    assert texts(tree) == ["A", "Fact 1", "Fact 2", "C", "Fact 1", "D"]
    less = editing.delete(more, [Address("A")])
    tree.show_blueprint(less, False)
    assert texts(tree) == ["B", "Fact 1", "C", "Fact 1", "D"]
    tree.show_blueprint(more, False)
    assert texts(tree) == ["A", "Fact 1", "Fact 2", "C", "Fact 1", "D"]


def test_an_sb_that_is_renamed_stays_as_it_stands(make: Make) -> None:
    blueprint = read(SMALL)
    tree = make(blueprint)
    tree.collapse(tree.index_of("A"))
    tree.mark(tree.index_of("C", 0))
    tree.show_blueprint(editing.rename(blueprint, Address("A"), "E"), False)
    assert texts(tree) == ["E", "C", "Fact 1"]
    assert line_of(tree.currentIndex()).branch == "C"
    tree.expand(tree.index_of("E"))
    assert texts(tree) == ["E", *OPEN[1:]]
    assert line_of(tree.index_of("E", 1)).text == "Fact 2"


def test_an_edit_tells_what_is_new_and_what_is_gone(make: Make) -> None:
    """Each blueprint follows each other one, and the tree shows it as a new tree does."""
    first = read(SMALL)
    found = [
        first,
        read("{}"),
        read(SMALL.replace('"B": 1', '"C": 0')),
        read(SMALL.replace('"B": 1', '"C": 0, "B": 1')),
        read(SMALL.replace('{"B": 1}', '{"A": 1}')),
        read(SMALL.replace('"B": {"T_0"', '"B": {"HEADER": {"SUB_SBS": {"C": 0}}, "T_0"')),
        read(SMALL.replace('"C": {"U_0": {}}', '"C": {}, "X": {"Y_000": {}}')),
        read('{"X": {"S_0": {}}, "C": {"U_0": {}}, "B": {"T_0": {}}, "A": {"S_00": {}}}'),
        editing.rename(first, Address("B"), "Z"),
    ]
    tree = make(first)
    for one in found:
        for other in found:
            tree.show_blueprint(one, False)
            tree.show_blueprint(other, False)
            assert texts(tree) == texts(make(other))
            tree.collapseAll()
            tree.show_blueprint(one, False)
            tree.expandAll()
            assert texts(tree) == texts(make(one))
            tree.show_blueprint(first, True)


def test_a_line_below_which_something_comes_can_be_opened(make: Make) -> None:
    blueprint = read('{"A": {}, "B": {"S_0": {}}}')
    tree = make(blueprint)
    assert not tree.lines.hasChildren(tree.index_of("A"))
    tree.show_blueprint(editing.add_state(blueprint, "A", "S_0"), False)
    assert tree.lines.hasChildren(tree.index_of("A"))
    assert texts(tree) == ["A", "Fact 1", "B", "Fact 1"]


def test_nothing_of_another_file_is_kept(make: Make) -> None:
    tree = make(read(SMALL))
    tree.collapse(tree.index_of("A"))
    tree.show_blueprint(read(SMALL, "other.json"), True)
    assert texts(tree) == OPEN


def test_a_star_opens_what_is_below_but_never_without_end(make: Make) -> None:
    tree = make(read(SMALL))
    tree.collapseAll()
    tree.setCurrentIndex(tree.index_of("A"))
    QTest.keyClick(tree, Qt.Key.Key_Asterisk)
    assert texts(tree) == ["A", "Fact 1", "Fact 2", "B", "Fact 1", "C"]
    deep = make(bomb("sub_diamonds", 100))
    deep.collapseAll()
    deep.setCurrentIndex(deep.index_of("l0"))
    QTest.keyClick(deep, Qt.Key.Key_Asterisk)
    assert 100 < len(shown(deep)) <= FULL + 10


def test_facts_are_painted_anew_only_after_an_edit_that_they_show(make: Make) -> None:
    blueprint = read(SMALL)
    tree = make(blueprint)
    told: list[str] = []
    tree.lines.dataChanged.connect(
        lambda first, last: told.extend(
            line_of(tree.lines.index(row, 0, first.parent())).text
            for row in range(first.row(), last.row() + 1)
        )
    )
    edits: tuple[tuple[Callable[[Blueprint], Blueprint], list[str]], ...] = (
        (lambda bp: editing.rename(bp, Address("A", "S_00", "o"), "p"), ["A"]),
        (lambda bp: editing.rename(bp, Address("A", "S_00"), "S_20"), ["A", "Fact 1", "Fact 2"]),
        (lambda bp: editing.set_note(bp, "A", "_facts", "1", {"name": "held"}),
         ["A", "Fact 1", "held"]),
    )  # fmt: skip
    for edit, changed in edits:
        told.clear()
        blueprint = edit(blueprint)
        tree.show_blueprint(blueprint, another=False)
        assert told == changed
