"""Typed texts that a form refused: what is said when the form shows something else."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QWidget

from smsl_studio.legible import one_line
from smsl_studio.studio.base.controls import Field
from smsl_studio.studio.base.lines.line import FormLine

LONGEST = 40
"""So many characters of a lost text are told."""


@dataclass(frozen=True)
class RefusedText:
    """A text that stands refused in a line of a form, with the reason."""

    line: FormLine
    text: str
    reason: str

    def lost_in(self, form: QWidget) -> bool:
        """Whether the line shows something else by now, or the form does not show the line."""
        field = self.line.field
        kept = isinstance(field, Field) and field.text() == self.text
        return not (kept and self.line.isVisibleTo(form))

    def sentence(self, who: str) -> str:
        """What was not taken, for whom, and why. ``who`` is an element; empty for none."""
        text = self.text if len(self.text) <= LONGEST else f"{self.text[:LONGEST]}…"
        of = f" of {who}" if who else ""
        return f"“{one_line(text)}” is not the {self.line.words}{of}: it was refused. {self.reason}"

    def forget(self) -> None:
        """Tell of this text only once."""
        self.line.refuse("")

    def put_back(self) -> None:
        """Type the text again, and give the line the keys."""
        if isinstance(self.line.field, Field):
            self.line.field.setText(self.text)
            self.line.field.setFocus()
            self.line.refuse(self.reason)


def refused_texts(form: QWidget) -> list[RefusedText]:
    """The texts that stand refused in the lines of a form."""
    found = []
    for line in form.findChildren(FormLine):
        field, reason = line.field, line.refusal.text()
        if reason and isinstance(field, Field) and field.changed:
            found.append(RefusedText(line, field.text(), reason))
    return found
