"""What the file would be if a version were chosen: computed beside the window."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.merge import Conflict, Side, choose, choose_all
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.features.merge.open_merge import WORDS

NAMED = 2
"""The preview names so many findings."""


class ChoicePreview(QObject):
    """Says what findings a choice would leave, without choosing."""

    told = Signal(object, str, str)
    """(Conflict, words, version)"""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._beside = Beside(self)

    def ask(self, blueprint: Blueprint, conflict: Conflict, side: Side) -> None:
        """Preview a version of a conflict. A former question is dropped."""
        self._beside.drop()
        self.told.emit(conflict, f"Preview: {WORDS[side]}. Checking", side)
        self._beside.do(
            partial(preview_words, blueprint, conflict, side),
            lambda words: self.told.emit(conflict, words, side),
        )

    def drop(self) -> None:
        """The preview is no longer wanted."""
        self._beside.drop()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()


def preview_words(blueprint: Blueprint, conflict: Conflict, side: Side) -> str:
    """The findings after a choice in words. The other open conflicts do not count: they keep
    mine."""
    try:
        after = choose_all(choose(blueprint, conflict, side), "ours")
    except EditRefused as error:
        return f"{WORDS[side]} cannot be taken. {refusal_words(error)}"
    return f"Preview: {WORDS[side]}. {findings_words(inspect(after), conflict.address)}"


def findings_words(findings: tuple[Finding, ...], address: str) -> str:
    """The numbers of errors and warnings, and the first errors; those at an element come first."""
    letters = [finding.severity.value for finding in findings]
    words = f"{counted(letters.count('E'), 'error')}, {counted(letters.count('W'), 'warning')}"
    errors = [finding for finding in findings if finding.severity.value == "E"]
    errors.sort(key=lambda finding: str(finding.address) != address)
    named = [f"{finding.rule} {finding.address}: {finding.message}" for finding in errors[:NAMED]]
    return "\n".join([words, *named])
