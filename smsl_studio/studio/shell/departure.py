"""What is asked before a window closes: everything first, and only then is anything done."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.document.files.files import Files


class Departure:
    """The answers of one window. A window that ``agreed`` closes without another question.

    ``may_end`` says whether the run may end; it is given what asks the person.
    """

    def __init__(
        self, may_end: Callable[[Callable[[str], bool]], bool], files: Files, dialogs: Dialogs
    ) -> None:
        self._may_end, self._files, self._dialogs = may_end, files, dialogs
        self._save = False
        self.agreed = False

    def ask(self, several: bool = False) -> bool:
        """Ask whether the run may end and whether to save; False where the window shall stay.

        Nothing is done yet. ``several`` windows are asked about: each question says more of the
        file, so that it is known which one is meant.
        """
        self._save = False
        if not self._may_end(self._dialogs.may_end_run):
            return False
        answer = self._files.ask_unsaved(several)
        self._save = answer == "save"
        return answer != "cancel"

    def save(self) -> bool:
        """Save where that was the answer; False where it could not be done, or was called off."""
        return not self._save or self._files.save()

    def may_close(self) -> bool:
        """Whether the window may close now; it asks unless it has ``agreed``."""
        return self.agreed or (self.ask() and self.save())
