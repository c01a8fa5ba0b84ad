"""The window passes no foreign text to Qt that Qt could read as markup."""

from __future__ import annotations

import ast
from itertools import pairwise
from pathlib import Path

import pytest

Trees = dict[str, ast.Module]
STUDIO = Path(__file__).parents[2] / "smsl_studio" / "studio"
TIPS = {"setToolTip": -1, "setWhatsThis": -1, "setStatusTip": -1, "showText": 1}
"""Methods whose text Qt looks into for markup, and which argument that is."""


@pytest.fixture(scope="module")
def trees() -> Trees:
    """The code of the window; it is freed after the last test of this file."""
    return {
        path.relative_to(STUDIO).as_posix(): ast.parse(path.read_text("utf-8"))
        for path in sorted(STUDIO.rglob("*.py"))
    }


def _is_safe(tree: ast.Module, text: ast.expr) -> bool:
    """A constant, or what ``tip_text`` made, also by way of a local name."""
    if isinstance(text, ast.IfExp):
        return _is_safe(tree, text.body) and _is_safe(tree, text.orelse)
    if isinstance(text, ast.Call):
        return isinstance(text.func, ast.Name) and text.func.id == "tip_text"
    if isinstance(text, ast.Name):
        given = [
            node.value
            for node in ast.walk(tree)
            if isinstance(node, ast.Assign)
            and any(isinstance(one, ast.Name) and one.id == text.id for one in node.targets)
        ]
        return any(_is_safe(tree, one) for one in given)
    return isinstance(text, ast.Constant)


def test_every_tool_tip_is_a_constant_or_comes_from_tip_text(trees: Trees) -> None:
    wrong = [
        f"{file}:{call.lineno}"
        for file, tree in trees.items()
        for call in ast.walk(tree)
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Attribute)
        and call.func.attr in TIPS
        and not _is_safe(tree, call.args[TIPS[call.func.attr]])
    ]
    assert wrong == []


def test_labels_message_boxes_and_markup_stand_in_one_place_each(trees: Trees) -> None:
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
            for file, tree in trees.items()
            for node in ast.walk(tree)
            if (isinstance(node, ast.Call) and getattr(node.func, "id", "") == name)
            or (isinstance(node, ast.Attribute) and node.attr == name)
            or (
                isinstance(node, ast.ClassDef)
                and name in {getattr(b, "id", "") for b in node.bases}
            )
        }
        assert found <= files, name


def test_a_fact_is_counted_from_1_and_a_digit_from_0(trees: Trees) -> None:
    """One sentence said "fact 0" and another "Fact 1" of the same fact."""
    wrong = [
        f"{file}:{text.lineno}"
        for file, tree in trees.items()
        for text in ast.walk(tree)
        if isinstance(text, ast.JoinedStr)
        for before, value in pairwise(text.values)
        if isinstance(before, ast.Constant) and isinstance(value, ast.FormattedValue)
        if str(before.value).casefold().endswith("fact ")
        if ast.unparse(value.value).rpartition(".")[2].lstrip("_") == "digit"
    ]
    assert wrong == []
