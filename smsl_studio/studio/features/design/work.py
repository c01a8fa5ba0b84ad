"""The work of the page Design cycle in other threads: finding out, trying, generating."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.beside import Beside

if TYPE_CHECKING:
    from smsl_studio.front.design.cycle import DesignCycle
    from smsl_studio.front.design.generation import GenerationRequest, NewGeneration


class DesignWork(QObject):
    """One of each at a time: the last question counts, and others are called off."""

    found = Signal(object, object)
    """(DesignCycle, Blueprint)"""
    came = Signal(object)
    """(NewGeneration): what was generated."""
    refused = Signal(object)
    """(StudioError): nothing was generated."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._finding, self._trying, self._generating = (Beside(self) for _ in range(3))
        self.generates = False

    def find(
        self, blueprint: Blueprint, path: Path | None, loaded: Loaded | None, policy: Path | None
    ) -> None:
        """Find the design cycle out."""
        self._finding.drop()
        work = partial(_cycle, blueprint, path, loaded, policy)
        self._finding.do(work, lambda cycle: self.found.emit(cycle, blueprint))

    def attempt(self, work: Callable[[], object], then: Callable[[object], object]) -> None:
        """Do ``work`` for a stage. ``then`` gets its result, or the StudioError that it raised."""

        def tried() -> object:
            try:
                return work()
            except StudioError as error:
                return error

        self._trying.drop()
        self._trying.do(tried, then)

    def drop_attempt(self) -> None:
        """Give up what is tried."""
        self._trying.drop()

    def generate(self, request: GenerationRequest, folder: Path, before: Blueprint | None) -> None:
        """Run the chain from the text."""
        from smsl_studio.front.design.generation import generate_anew

        def work() -> NewGeneration | StudioError:
            """Run it in the worker thread."""
            try:
                return generate_anew(request, folder, before)
            except StudioError as error:
                return error

        self._generating.drop()
        self.generates = True
        self._generating.do(work, self._generated)

    def cancel(self) -> None:
        """Ask nobody any more."""
        self._generating.drop()
        self.generates = False

    def stop(self) -> None:
        """End all work, because the window closes."""
        for beside in (self._finding, self._trying, self._generating):
            beside.stop()

    def _generated(self, came: NewGeneration | StudioError) -> None:
        self.generates = False
        (self.refused if isinstance(came, StudioError) else self.came).emit(came)


def _cycle(
    blueprint: Blueprint, path: Path | None, loaded: Loaded | None, policy: Path | None
) -> DesignCycle:
    from smsl_studio.front.approval_badge import approval_words
    from smsl_studio.front.design.cycle import design_cycle

    return design_cycle(blueprint, path, loaded, approval_words(blueprint, policy))
