"""The two dialogs of the Help menu: keyboard shortcuts, and about."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from smsl_studio.studio.base.actions import Action, Actions, key_words
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.feature import KeyList
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.shell.frame.key_table import KeyTable
from smsl_studio.studio.shell.frame.menu_row import MENUS


def shortcuts_dialog(actions: Actions, own: Iterable[KeyList], parent: QWidget) -> QDialog:
    """All shortcuts: ``own`` are those that are no actions; the others follow by menu."""
    dialog = QDialog(parent)
    dialog.setWindowTitle("Keyboard shortcuts")
    open_at(dialog, 560, 620)
    rows: list[tuple[str, list[tuple[str, str]]]] = [(title, list(lines)) for title, lines in own]
    for menu in MENUS:
        keyed = [action for action in actions.in_menu(menu) if action.keys]
        rows.append((menu, [(_words(action), _keys(action)) for action in keyed]))
    _finish(dialog, KeyTable([(title, tuple(lines)) for title, lines in rows if lines]))
    return dialog


def about_dialog(parent: QWidget) -> QDialog:
    """The name, version and purpose of the program, and what it must not be used for."""
    dialog = QDialog(parent)
    dialog.setWindowTitle("About SMSL Studio")
    dialog.setFixedWidth(440)
    text = QVBoxLayout()
    text.setContentsMargins(20, 20, 20, 8)
    text.setSpacing(8)
    text.addWidget(label(f"SMSL Studio {_version()}", "heading"))
    for said in (
        "Draw, inspect and run blueprints of medical and robotic procedures: hierarchical state "
        "machines in the State Machine Serialization Language.",
        "It is research software and not a medical device. It runs blueprints in simulation only.",
    ):
        line = label(said, "second")
        line.setWordWrap(True)
        text.addWidget(line)
    inner = QWidget()
    inner.setLayout(text)
    _finish(dialog, inner)
    return dialog


def _finish(dialog: QDialog, inner: QWidget) -> None:
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    close = QPushButton("Close")
    close.setDefault(True)
    close.clicked.connect(dialog.accept)
    foot = QHBoxLayout()
    foot.setContentsMargins(20, 8, 20, 16)
    foot.addStretch(1)
    foot.addWidget(close)
    whole = QVBoxLayout(dialog)
    whole.setContentsMargins(0, 0, 0, 0)
    whole.addWidget(inner, 1)
    whole.addLayout(foot)


def _words(action: Action) -> str:
    return action.words.rstrip("…")


def _keys(action: Action) -> str:
    return " or ".join(key_words(key) for key in action.keys)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("smsl-studio")
    except PackageNotFoundError:
        return ""
