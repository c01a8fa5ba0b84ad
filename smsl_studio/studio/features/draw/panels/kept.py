"""Shows the fields of a file that Studio has no form for. They stay in the file unchanged."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from itertools import islice
from typing import Any

from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.legible import markup
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.words import first_lines

LONGEST, MOST = 60, 24
BREAK = "&#8203;"
"""An invisible place in markup where a line may break."""


class KeptValues(QWidget):
    """Keys and values under a heading, read-only. It is hidden if there are none."""

    def __init__(self, title: str) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 6, 0, 0)
        column.setSpacing(2)
        column.addWidget(label(title, "small"))
        self.words = Label(rich=True)
        self.words.setProperty("role", "terms")
        self.words.setWordWrap(True)
        self.setToolTip("Studio has no field for these. They are kept in every edit and form.")
        column.addWidget(self.words)

    def show_values(self, values: Mapping[str, Any]) -> None:
        """Show these keys and values."""
        shown = [_line(key, value) for key, value in islice(values.items(), MOST)]
        self.words.setText(first_lines(shown, MOST, len(values)).replace("\n", "<br>"))
        self.setVisible(bool(values))


def kept_fields(fields: Mapping[str, Any], known: Collection[str]) -> dict[str, Any]:
    """The fields whose keys are not in ``known``."""
    return {key: value for key, value in fields.items() if key not in known}


def _line(key: str, value: Any) -> str:
    text = value if isinstance(value, str) else _json(value)
    line = f"{key}: {text}".replace("\n", " ")
    line = line if len(line) <= LONGEST else f"{line[: LONGEST - 1]}…"
    # A word that cannot be broken would make the panel wider.
    return BREAK.join(markup(line[at : at + 24]) for at in range(0, len(line), 24))


def _json(value: Any) -> str:
    if isinstance(value, dict | list) and len(value) > LONGEST:
        return f"{'map' if isinstance(value, dict) else 'list'} of {len(value):,}"
    try:
        return json.dumps(value, ensure_ascii=False)
    except (ValueError, RecursionError):
        return "…"
