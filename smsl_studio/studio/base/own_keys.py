"""Keys that a person has chosen: how they stand in the settings, and what they must not be."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence

from smsl_studio.studio.base.actions import Action, key_words

Keys = Mapping[str, tuple[str, ...]]
"""The chosen keys by the id of their action; no key means that the person took it away."""
FIXED = frozenset({"run_stop", "help_here"})
"""The actions whose keys stay: Stop and help have their keys in every dialog, too."""
MOST = 500
"""The largest number of actions with chosen keys that is read."""


def read_keys(text: str) -> dict[str, tuple[str, ...]]:
    """The chosen keys from their text in the settings; what does not fit is left out."""
    try:
        found = json.loads(text or "{}")
    except (ValueError, RecursionError):
        return {}
    if not isinstance(found, dict):
        return {}
    return {
        str(name): tuple(one for one in keys if isinstance(one, str) and one)
        for name, keys in list(found.items())[:MOST]
        if isinstance(keys, list)
    }


def written_keys(keys: Keys) -> str:
    """The chosen keys as the settings keep them."""
    return json.dumps({name: list(keys[name]) for name in sorted(keys)})


def objection(table: Iterable[Action], action: Action, key: str) -> str:
    """Why an action cannot have a key, as a sentence; empty if it can.

    Single letters are keys of the canvas and are typed in fields. A key that another action has is
    told with its name.
    """
    wanted = QKeySequence(key)
    if action.id in FIXED or action.scope != "window":
        return f"The key of “{action.words}” cannot be changed."
    if wanted.count() != 1 or not wanted.toString():
        return "Press one key, with Ctrl, Alt or Shift held if you like."
    combination = wanted[0]  # type: ignore[index]
    held = combination.keyboardModifiers() & ~Qt.KeyboardModifier.ShiftModifier
    code = combination.key()
    if not held and not Qt.Key.Key_F1 <= code <= Qt.Key.Key_F35:
        return f"{key_words(key)} is typed in fields and moves in lists. Hold Ctrl or Alt with it."
    for other in table:
        if other.id != action.id and any(_same(one, wanted) for one in other.keys):
            words = other.words.rstrip("…")
            return f"{key_words(key)} belongs to “{words}”. Choose another key, or clear that one."
    return ""


def _same(key: str, wanted: QKeySequence) -> bool:
    return QKeySequence(key).matches(wanted) != QKeySequence.SequenceMatch.NoMatch
