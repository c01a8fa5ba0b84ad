"""The section “Who changed this” of the properties: asked of git on demand."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel

if TYPE_CHECKING:
    from smsl_studio.front.last_change import LastChange

MOST = 12
"""So many lines of the former text are shown."""


class LastChangeForm(Panel):
    """Says who changed the selected element last, when and why, and how it looked before.

    git is asked in the background, and only after a click. Another selection and every edit end
    the search and hide its answer.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__("Who changed this", parent)
        self._session = session
        self._address: Address | None = None
        self._beside = Beside(self)
        self.column.setContentsMargins(12, 0, 12, 12)
        self.column.setSpacing(4)
        self.ask = QPushButton("Who changed this")
        self.ask.setProperty("role", "link")
        self.ask.setToolTip("Ask git for the last commit that changed the meaning of this element")
        self.cancel = QPushButton("Cancel")
        self.cancel.setProperty("role", "row")
        self.cancel.setToolTip("Stop looking")
        self.ask.clicked.connect(self._ask)
        self.cancel.clicked.connect(self._cancel)
        self._who, self._why = self._words("strong"), self._words("second")
        self._what, self._before = self._words("small"), self._words("small")
        self._lines = self._words("mono")
        self._rest = self._words("small")
        self.column.addLayout(row(self.ask, None, self.cancel))
        for words in self._all:
            self.column.addWidget(words)
        session.blueprint_changed.connect(lambda *_: self._forget())
        self._forget()

    def _words(self, role: str) -> Label:
        made = label("", role)
        made.setWordWrap(True)
        return made

    @property
    def _all(self) -> tuple[Label, ...]:
        return self._who, self._why, self._what, self._before, self._lines, self._rest

    @property
    def words(self) -> str:
        """All that is said now."""
        return "\n".join(one.text() for one in self._all if one.text())

    def show_element(self, address: Address | None) -> None:
        """Offer the question about another element; None hides it."""
        self.setVisible(address is not None)
        if address != self._address:
            self._address = address
            self._forget()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _ask(self) -> None:
        address, blueprint = self._address, self._session.blueprint
        if address is None:
            return
        self._forget()
        file = Path(blueprint.home(address.branch).file)
        if not file.is_file():
            self._say(self._who, "The file is not saved yet, so git does not know it.")
            return
        self._say(self._who, "Looking in git")
        self.ask.setEnabled(False)
        self.cancel.show()
        work = partial(_tried, blueprint, address, file)
        self._beside.do(work, partial(self._found, address, blueprint))

    def _cancel(self) -> None:
        self._forget()
        self._say(self._who, "Stopped looking.")

    def _forget(self) -> None:
        self._beside.drop()
        self.ask.setEnabled(True)
        self.cancel.hide()
        for words in self._all:
            self._say(words, "")

    def _say(self, words: Label, text: str) -> None:
        words.setText(text)
        words.setVisible(bool(text))

    def _found(self, address: Address, blueprint: Blueprint, found: LastChange | ReadError) -> None:
        if address != self._address or blueprint is not self._session.blueprint:
            return
        self._forget()
        if isinstance(found, ReadError):
            self._say(self._who, refusal_words(found))
            return
        one = found.revision
        if one is not None:
            self._say(self._who, f"{one.author}, {one.when[:10]}")
            self._say(self._why, f"{one.subject or 'No message'} ({one.short})")
            self._say(self._what, "\n".join(found.changes[:MOST]))
            self._say(self._before, "Before" if found.lines else "It was not there before.")
            self._say(self._lines, _cut(found.lines))
        else:
            self._say(self._who, f"{found.reason}.")
        self._say(self._rest, _rest(found))


def _rest(found: LastChange) -> str:
    words = []
    if found.uncommitted:
        words.append("Changed since the last commit: " + " ".join(found.uncommitted[:MOST]))
    if found.unread:
        unread = counted(found.unread, "version")
        words.append(f"{unread} in git cannot be read and {'was' if found.unread == 1 else 'were'} "
                     "passed over.")  # fmt: skip
    return "\n".join(words)


def _cut(lines: tuple[str, ...]) -> str:
    """The first lines, without their common indentation."""
    indent = min((len(one) - len(one.lstrip()) for one in lines if one.strip()), default=0)
    shown = [one[indent:].rstrip() for one in lines[:MOST]]
    more = len(lines) - len(shown)
    return "\n".join([*shown, f"and {counted(more, 'line')} more"] if more > 0 else shown)


def _tried(blueprint: Blueprint, address: Address, file: Path) -> LastChange | ReadError:
    from smsl_studio.front.last_change import last_change

    try:
        return last_change(blueprint, address, file)
    except ReadError as error:
        return error
