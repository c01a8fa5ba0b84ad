"""What was selected at each step of the history, to select it again after an undo."""

from __future__ import annotations

from PySide6.QtCore import QObject

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.studio.document.session import Session


class SelectionMemory(QObject):
    """Selects again after an undo or redo what was selected before, if nothing else is selected.

    So keys act on the state that an undo has brought back. What does not exist is left out.
    """

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        self._session = session
        self._chosen: dict[int, tuple[Address, ...]] = {}
        """The selection by the index of the history."""
        self._opening = self._stepping = False
        session.opened.connect(self._forget)
        session.blueprint_changed.connect(lambda *_: self._begin())
        session.selection_changed.connect(self._remember)
        # A method and not a lambda, because Qt disconnects it before the history is deleted.
        session.history.indexChanged.connect(self._stepped)

    def _forget(self) -> None:
        self._chosen.clear()
        self._opening = True

    def _begin(self) -> None:
        """A step is under way, unless another file was opened. What it deselects stays known."""
        self._stepping = not self._opening
        self._opening = False

    def _remember(self, selection: tuple[Address, ...]) -> None:
        if not self._stepping:
            self._chosen[self._session.history.index()] = selection

    def _stepped(self, index: int) -> None:
        session, self._stepping = self._session, False
        if session.adds_step:
            self._chosen[index] = session.selection
        elif not session.selection and session.fact is None:
            known = self._chosen.get(index, ())
            session.select(tuple(one for one in known if self._is_shown(one)))

    def _is_shown(self, address: Address) -> bool:
        """Whether an element exists in the SB that is shown."""
        try:
            self._session.blueprint.resolve(address)
        except StudioError:
            return False
        return address.branch == self._session.branch
