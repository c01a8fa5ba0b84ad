"""What the widgets of a run read: a run that goes on, or one that is told again."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.studio.document.places import Places
from smsl_studio.studio.running.story import Story


class DrawnPlaces(Protocol):
    """Where the drawing stands that a run may differ from."""

    @property
    def blueprint(self) -> Blueprint: ...
    @property
    def places(self) -> Places: ...


class ShownRun(Protocol):
    """A run as it is shown. ``exists`` says whether it can be commanded."""

    @property
    def blueprint(self) -> Blueprint | None: ...
    @property
    def status(self) -> DispatchStatus | None: ...
    @property
    def story(self) -> Story: ...
    @property
    def shown(self) -> bool: ...
    @property
    def foreign(self) -> bool: ...
    def is_another(self, drawn: Blueprint) -> bool: ...
    @property
    def exists(self) -> bool: ...
    @property
    def phase(self) -> str: ...
    @property
    def sentence(self) -> str: ...
