"""What the widgets of a run read. Both a live run and a replay offer it."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.runlog.history import Story
from smsl_studio.studio.document.places import Places


class DrawnPlaces(Protocol):
    """The drawing, from which a run may differ."""

    @property
    def blueprint(self) -> Blueprint:
        """The blueprint as it is drawn now."""

    @property
    def places(self) -> Places:
        """The places of its states."""


class ShownRun(Protocol):
    """A run that is shown, live or replayed."""

    @property
    def blueprint(self) -> Blueprint | None:
        """The blueprint of the run; None without a run."""

    @property
    def status(self) -> DispatchStatus | None:
        """The status of the run; None while it is not known."""

    @property
    def story(self) -> Story:
        """What has happened so far."""

    @property
    def shown(self) -> bool:
        """Whether there is something to show, also after the end of the run."""

    @property
    def foreign(self) -> bool:
        """Whether the run belongs to another file than the drawing."""

    def is_another(self, drawn: Blueprint) -> bool:
        """Whether the run's blueprint differs from what is drawn."""

    @property
    def exists(self) -> bool:
        """Whether there is a run that can be commanded."""

    @property
    def phase(self) -> str:
        """The phase of the run in one word; empty without a run."""

    @property
    def sentence(self) -> str:
        """Why the run holds or ended; empty while it goes on."""
