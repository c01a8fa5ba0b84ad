"""The window passes no foreign text to Qt that Qt could read as markup."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

STUDIO = Path(__file__).parents[2] / "smsl_studio" / "studio"
TREES = {
    path.relative_to(STUDIO).as_posix(): ast.parse(path.read_text("utf-8"))
    for path in sorted(STUDIO.rglob("*.py"))
}
TIPS = {"setToolTip": -1, "setWhatsThis": -1, "setStatusTip": -1, "showText": 1}
"""Methods whose text Qt looks into for markup, and which argument that is."""


def _calls() -> Iterator[tuple[str, ast.Call]]:
    for file, tree in TREES.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call):
                yield file, node


def _is_safe(file: str, text: ast.expr) -> bool:
    """A constant, or what ``tip_text`` made, also by way of a local name."""
    if isinstance(text, ast.IfExp):
        return _is_safe(file, text.body) and _is_safe(file, text.orelse)
    if isinstance(text, ast.Call):
        return isinstance(text.func, ast.Name) and text.func.id == "tip_text"
    if isinstance(text, ast.Name):
        given = [
            node.value
            for node in ast.walk(TREES[file])
            if isinstance(node, ast.Assign)
            and any(isinstance(one, ast.Name) and one.id == text.id for one in node.targets)
        ]
        return any(_is_safe(file, one) for one in given)
    return isinstance(text, ast.Constant)


def test_every_tool_tip_is_a_constant_or_comes_from_tip_text() -> None:
    wrong = [
        f"{file}:{call.lineno}"
        for file, call in _calls()
        if isinstance(call.func, ast.Attribute)
        and call.func.attr in TIPS
        and not _is_safe(file, call.args[TIPS[call.func.attr]])
    ]
    assert wrong == []


def test_labels_message_boxes_and_markup_stand_in_one_place_each() -> None:
    homes = {
        "QLabel": {"base/controls.py"},
        "QMessageBox": {"document/files/dialogs.py"},
        "RichText": {"base/controls.py"},
        "setHtml": set(),
        "insertHtml": set(),
        "QTextDocument": set(),
        "setMarkdown": {"features/help/page_view.py"},
    }
    for name, files in homes.items():
        found = {
            file
            for file, tree in TREES.items()
            for node in ast.walk(tree)
            if (isinstance(node, ast.Call) and getattr(node.func, "id", "") == name)
            or (isinstance(node, ast.Attribute) and node.attr == name)
            or (
                isinstance(node, ast.ClassDef)
                and name in {getattr(b, "id", "") for b in node.bases}
            )
        }
        assert found <= files, name


def test_a_fact_is_counted_from_1_and_a_digit_from_0() -> None:
    """One sentence said "fact 0" and another "Fact 1" of the same fact."""
    wrong = [
        f"{file}:{text.lineno}"
        for file, tree in TREES.items()
        for text in ast.walk(tree)
        if isinstance(text, ast.JoinedStr)
        for before, value in pairwise(text.values)
        if isinstance(before, ast.Constant) and isinstance(value, ast.FormattedValue)
        if str(before.value).casefold().endswith("fact ")
        if ast.unparse(value.value).rpartition(".")[2].lstrip("_") == "digit"
    ]
    assert wrong == []
