"""The questions before a window closes. All are asked before anything is done."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.document.files.files import Files


class Departure:
    """The questions of one window, and their answers.

    After ``agreed`` is set, the window closes without asking.

    ``may_end`` returns whether the run may end. Its argument asks the person.
    """

    def __init__(
        self, may_end: Callable[[Callable[[str], bool]], bool], files: Files, dialogs: Dialogs
    ) -> None:
        self._may_end, self._files, self._dialogs = may_end, files, dialogs
        self._save = False
        self.agreed = False

    def ask(self, several: bool = False) -> bool:
        """Ask whether the run may end and whether to save; False if the window shall stay open.

        Nothing is done yet. ``several`` says that several windows are asked about. The question
        then says more about the file.
        """
        self._save = False
        if not self._may_end(self._dialogs.may_end_run):
            return False
        answer = self._files.ask_unsaved(several)
        self._save = answer == "save"
        return answer != "cancel"

    def save(self) -> bool:
        """Save if that was the answer; False if that failed or was cancelled."""
        return not self._save or self._files.save()

    def may_close(self) -> bool:
        """Whether the window may close now. It asks, unless ``agreed`` is set."""
        return self.agreed or (self.ask() and self.save())
