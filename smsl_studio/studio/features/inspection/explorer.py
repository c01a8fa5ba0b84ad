"""Explorer: a walk through the configurations of the drawing, with the steps that are permitted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.inspection.explorer.onward import ConfigurationWalk, OnwardStep
from smsl_studio.inspection.explorer.run_to import RunThere, shortest_run_to
from smsl_studio.studio.base.beside import Beside, Came
from smsl_studio.studio.base.words import refusal_words
from smsl_studio.studio.document.inspector import LIMIT
from smsl_studio.studio.document.renamed import now_named, same_branch
from smsl_studio.studio.document.session import Session

STOPPED = "Stopped looking."
BROKEN = "The text of the file cannot be read. What is permitted is known when it is repaired."
NOTHING = "There is no State Branch yet. Draw one, then walk through what it permits here."


@dataclass(frozen=True)
class _KnownPlace:
    """What a search has found: the walk, the configuration, and the steps out of it."""

    walk: ConfigurationWalk
    here: Mapping[str, str]
    steps: tuple[OnwardStep, ...]


class Explorer(QObject):
    """Walks through the configurations of the drawing. It runs nothing and edits nothing.

    All searches run in a second thread. ``trail`` has the configuration where the walk began, and
    the steps from there. ``steps`` has the operations out of the present configuration. It is None
    until they are known.
    """

    changed = Signal()
    """The configuration has changed, or a search has ended or begun."""
    refused = Signal(str)
    """str: why there is no configuration with the wanted states."""
    found = Signal(object)
    """Counterexample: the shortest run from the start to the present configuration."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._beside = session, Beside(self)
        self._asked: Blueprint | None = None
        self._walk: ConfigurationWalk | None = None
        self._past: list[tuple[RunStep, ...]] = []
        self.trail: tuple[RunStep, ...] = ()
        self.steps: tuple[OnwardStep, ...] | None = None
        self.work = ""
        """What the present search looks for, in words. Empty if there is no search."""
        self.said = ""
        """A sentence for the person, for example why there is no configuration. It may be empty."""
        session.blueprint_changed.connect(self._edited)
        session.broken_changed.connect(self._forget)
        session.opened.connect(self._opened)

    @property
    def configuration(self) -> Mapping[str, str]:
        """The active state of each SB. Empty if there is no configuration."""
        return self.trail[-1].configuration if self.trail else {}

    @property
    def is_outdated(self) -> bool:
        """Whether the drawing has changed since the last search began."""
        return self._asked is not self._session.blueprint

    @property
    def can_go_back(self) -> bool:
        """Whether the walk can go back to an earlier configuration."""
        return bool(self._past)

    def look(self) -> None:
        """Search the steps out of the present configuration, if the drawing has changed since the
        last search.
        """
        if not self.is_outdated:
            return
        blueprint = self._asked = self._session.blueprint
        if self._session.broken is not None or not blueprint.branches:
            self.trail, self.steps = (), None
            self.said = BROKEN if self._session.broken is not None else NOTHING
            self.changed.emit()
            return
        here = self.configuration
        self._do("Looking at the steps", partial(_stood, blueprint, here), self._stood)

    def look_again(self) -> None:
        """Search again after the person has ended a search."""
        self._asked = None
        self.look()

    def take(self, step: OnwardStep) -> None:
        """Take a permitted step. Other steps are ignored."""
        if self.steps is None or step not in self.steps or not step.permitted:
            return
        here = {**self.configuration, **step.after}
        moved = frozenset(name for name in here if here[name] != self.configuration[name])
        self._past.append(self.trail)
        self._go((*self.trail, RunStep(step.address, here, moved, step.edges)))

    def back(self) -> None:
        """Go back to the configuration before the last step or jump."""
        if self._past:
            self._go(self._past.pop())

    def to_start(self) -> None:
        """Go to the configuration in which a run starts."""
        walk = self._walk
        if walk is not None and self.trail:
            self._jump(partial(_placed, walk, walk.start(), {}))

    def place(self, wanted: Mapping[str, str]) -> None:
        """Go to a configuration in which some SBs are in the wanted states, or emit ``refused``."""
        walk = self._walk
        if walk is not None and self.trail:
            self._jump(partial(_placed, walk, wanted, self.configuration))

    def find_run(self) -> None:
        """Search the shortest run from the start to the present configuration."""
        blueprint, here = self._session.blueprint, self.configuration
        if here and self._asked is blueprint:
            work = partial(_run_there, blueprint, here)
            self._do("Looking for the shortest run", work, self._found)

    def call_off(self) -> None:
        """End the present search, because the person wants it. Earlier results stay."""
        if not self.work:
            return
        self._beside.drop()
        self.work, self.said = "", STOPPED
        self.changed.emit()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _do(self, words: str, work: Callable[[], Came], then: Callable[[Came], object]) -> None:
        self._beside.drop()
        self.work, self.said = words, ""
        self._beside.do(work, then)
        self.changed.emit()

    def _jump(self, work: Callable[[], _KnownPlace | StudioError]) -> None:
        self._do("Looking at the steps", work, self._placed)

    def _go(self, trail: tuple[RunStep, ...]) -> None:
        assert self._walk is not None
        self.trail, self.steps = trail, None
        work = partial(_onward, self._walk, self.configuration)
        self._do("Looking at the steps", work, self._onward)

    def _stood(self, came: _KnownPlace | StudioError) -> None:
        self.work = ""
        if isinstance(came, StudioError):
            self._walk, self.trail, self.steps = None, (), None
            self.said = refusal_words(came)
        else:
            gone = any(came.here[name] != state for name, state in self.configuration.items()
                       if name in came.here)  # fmt: skip
            self.said = "Where it stood is gone, so it is at the start again." if gone else ""
            self._walk, self.steps = came.walk, came.steps
            self.trail = (RunStep(None, came.here),)
        self.changed.emit()

    def _placed(self, came: _KnownPlace | StudioError) -> None:
        self.work = ""
        if not isinstance(came, StudioError) and dict(came.here) != dict(self.configuration):
            self._past.append(self.trail)
            self.trail, self.steps = (RunStep(None, came.here),), came.steps
        self.changed.emit()
        if isinstance(came, StudioError):
            self.refused.emit(refusal_words(came))

    def _onward(self, steps: tuple[OnwardStep, ...]) -> None:
        self.work, self.steps = "", steps
        self.changed.emit()

    def _found(self, came: RunThere | StudioError) -> None:
        self.work = ""
        if isinstance(came, StudioError):
            self.said = refusal_words(came)
        elif came.run is None and came.bound:
            self.said = f"Not known: the search met its limit, {came.bound}."
        elif came.run is None:
            self.said = "No run from the start leads here."
        elif not came.run.path:
            self.said = "A run starts here."
        self.changed.emit()
        if isinstance(came, RunThere) and came.run is not None and came.run.path:
            self.found.emit(came.run)
        self._look_on()

    def _look_on(self) -> None:
        """Search the steps whose search was left for a run."""
        if self.steps is None and self._walk is not None and self.trail and not self.work:
            said = self.said
            work = partial(_onward, self._walk, self.configuration)
            self._do("Looking at the steps", work, self._onward)
            self.said = said

    def _opened(self) -> None:
        self.trail = ()
        self._forget()

    def _edited(self, before: Blueprint, after: Blueprint) -> None:
        """Keep the present configuration after an edit, with the new names of its states.

        The steps that led there are forgotten, because they may not be possible any more.
        """
        here = {}
        for name, state in self.configuration.items():
            now = now_named(before, after, Address(name, state))
            here[same_branch(before, after, name)] = now.state
        self.trail = (RunStep(None, here),) if here else ()
        self._forget()

    def _forget(self) -> None:
        self._beside.drop()
        self._past.clear()
        self._asked = self._walk = self.steps = None
        self.work = self.said = ""
        self.changed.emit()


# The worker thread calls the functions below.


def _stood(blueprint: Blueprint, here: Mapping[str, str]) -> _KnownPlace | StudioError:
    """Search the steps out of a configuration. If it no longer exists, search from the start."""
    try:
        walk = ConfigurationWalk(blueprint)
        known = {
            name: state
            for name, state in here.items()
            if name in blueprint.branches and state in blueprint[name].table
        }
        start = walk.start()
        if known.keys() == here.keys() and here:
            with suppress(StudioError):
                start = walk.placed(known, start)
        return _KnownPlace(walk, start, walk.steps(start))
    except StudioError as error:
        return error


def _placed(
    walk: ConfigurationWalk, wanted: Mapping[str, str], otherwise: Mapping[str, str]
) -> _KnownPlace | StudioError:
    try:
        here = walk.placed(wanted, otherwise)
    except StudioError as error:
        return error
    return _KnownPlace(walk, here, walk.steps(here))


def _onward(walk: ConfigurationWalk, here: Mapping[str, str]) -> tuple[OnwardStep, ...]:
    return walk.steps(here)


def _run_there(blueprint: Blueprint, here: Mapping[str, str]) -> RunThere | StudioError:
    try:
        return shortest_run_to(blueprint, here, LIMIT)
    except StudioError as error:
        return error
