"""Inspector: inspects the blueprint in a second thread after every change.

The rules are pure functions of a frozen blueprint. So the window does not freeze while a large
blueprint is inspected. After the rules, the hazards and properties are answered, which may take
longer. If a person has chosen a world, the rules about worlds are checked, too.

Findings of a blueprint that is no longer shown are dropped. The findings of the last blueprints are
kept, because an undo shows the same blueprint again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, WorldError
from smsl_studio.inspection.inspect import ALL, in_order, inspect, order
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.beside import Beside, Tally
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.front.claim_rows import ClaimAnswers, ClaimRow
    from smsl_studio.front.proof import Proof
    from smsl_studio.library.loaded import Loaded

KEPT = 40
"""The findings of so many blueprints are kept. An undo shows those of its blueprint at once."""
WAIT = 120
"""Milliseconds from an edit to its inspection; another edit in that time starts the wait again."""
PATIENCE = 150
"""Milliseconds for which the findings of the rules wait for those of properties, so that the list
changes once. After that they are shown alone."""
LIMIT = 50_000
"""The largest number of configurations that are looked at. ``check`` looks at more."""


@dataclass(frozen=True)
class _Known:
    """What is known of a blueprint. ``answered`` is None until its properties are answered."""

    blueprint: Blueprint
    findings: tuple[Finding, ...]
    answered: ClaimAnswers | None = None


class Inspector(QObject):
    """Keeps the findings and the verdicts of the session's blueprint up to date."""

    found = Signal(object)
    """tuple[Finding]: the findings of the blueprint that is shown now. It comes a second time if
    the properties take longer than the rules."""
    started = Signal()
    """The blueprint changed, so the former findings and verdicts may no longer hold."""
    listed = Signal()
    """``unanswered`` is there: what another file says must hold, before it is answered."""
    proved = Signal()
    """``answered`` is there: the verdicts about the blueprint that is shown now."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._beside = Beside(self)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._inspect)
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.timeout.connect(self._tell)
        self._wanted: Blueprint | None = None
        self.findings: tuple[Finding, ...] = ()
        self._known: dict[int, _Known] = {}
        """What is known of the last inspected blueprints, by the id of the blueprint."""
        self.current = False
        """Whether ``findings`` belong to the blueprint that is shown."""
        self.answered: ClaimAnswers | None = None
        """The verdicts about the blueprint that is shown; None as long as they are not known."""
        self.unanswered: tuple[ClaimRow, ...] = ()
        """The hazards and properties of a file that was just opened, without verdicts."""
        self._unlisted = True
        self._tally = Tally()
        self.stopped = False
        """Whether a person has stopped the search for verdicts about this blueprint."""
        self.world = ""
        """The world that a person has chosen for this file. Empty if no world is chosen."""
        self._loaded: Loaded | None = None
        self._robot = ""
        session.opened.connect(self._forget)
        session.blueprint_changed.connect(lambda *_: self._changed())
        self._changed()

    @property
    def rules(self) -> int:
        """The number of rules that are checked."""
        return len(ALL)

    @property
    def proof(self) -> Proof | None:
        """The verdicts about the blueprint that is shown; None as long as they are not known."""
        return None if self.answered is None else self.answered.proof

    @property
    def rows(self) -> tuple[ClaimRow, ...]:
        """The verdicts in rows; none as long as they are not known."""
        return () if self.answered is None else self.answered.rows

    @property
    def proving(self) -> bool:
        """Whether ``findings`` do not have those of hazards and properties yet."""
        return self.current and self.proof is None

    @property
    def looked_at(self) -> int:
        """The number of configurations that were found so far. 0 where they are not counted."""
        return self._tally.count

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._patience.stop()
        self._wanted = None
        self._beside.stop()

    def stop_looking(self) -> None:
        """Call off the search for verdicts. The findings of the rules stay."""
        if self._wanted is not None and self.proof is None:
            self._beside.drop()
            self.stopped = True
            self._tell()

    def look_again(self) -> None:
        """Inspect the same blueprint once more."""
        self._known.pop(id(self._session.blueprint), None)
        self._changed(0)

    def look_in(self, world: str, loaded: Loaded | None, robot: str = "") -> None:
        """Check the rules about worlds, too (R24 to R26). ``loaded`` has the known plugins,
        ``robot`` is empty for the usual one of the world."""
        if (world, loaded, robot) != (self.world, self._loaded, self._robot):
            self.world, self._loaded, self._robot = world, loaded, robot
            self._known.clear()
            self._changed(0)

    def _forget(self) -> None:
        self._known.clear()
        self.world, self._loaded, self._robot = "", None, ""
        self._unlisted, self.unanswered = True, ()

    def _changed(self, wait: int = WAIT) -> None:
        self.current, self.answered, self.stopped = False, None, False
        self._patience.stop()
        self._beside.drop()
        self._wanted = None
        self.started.emit()
        known = self._known.get(id(self._session.blueprint))
        self._timer.start(0 if known is not None and known.answered else wait)

    def _inspect(self) -> None:
        blueprint = self._wanted = self._session.blueprint
        self._beside.drop()
        known = self._known.get(id(blueprint))
        if known is not None:
            self._arrived(blueprint, known.findings)
        else:
            look = partial(_inspected, blueprint, self.world, self._loaded, self._robot)
            self._beside.do(look, partial(self._arrived, blueprint))

    def _arrived(self, blueprint: Blueprint, findings: tuple[Finding, ...]) -> None:
        if not self._is_wanted(blueprint):
            return
        known = self._known.get(id(blueprint)) or _Known(blueprint, findings)
        self._keep(known)
        self.findings = known.findings
        if known.answered is not None:
            self._answered(blueprint, known.answered)
            return
        self._patience.start(PATIENCE)
        self._tally = tally = Tally()
        if self._unlisted:
            self._beside.do(partial(_listed, blueprint), partial(self._list, blueprint))
        answer = partial(_answer, blueprint, tally.tell)
        self._beside.do(answer, partial(self._answered, blueprint))

    def _list(self, blueprint: Blueprint, rows: tuple[ClaimRow, ...]) -> None:
        if self._is_wanted(blueprint):
            self._unlisted, self.unanswered = False, rows
            self.listed.emit()

    def _answered(self, blueprint: Blueprint, came: ClaimAnswers) -> None:
        if not self._is_wanted(blueprint):
            return
        known = self._known.get(id(blueprint)) or _Known(blueprint, self.findings)
        self._keep(_Known(blueprint, known.findings, came))
        every = (*known.findings, *came.proof.findings)
        if came.proof.findings:
            every = tuple(sorted(every, key=partial(order, blueprint)))
        self.findings, self.answered = every, came
        self._tell()
        self.proved.emit()

    def _is_wanted(self, blueprint: Blueprint) -> bool:
        return blueprint is self._session.blueprint and blueprint is self._wanted

    def _keep(self, known: _Known) -> None:
        self._known[id(known.blueprint)] = known
        while len(self._known) > KEPT:
            del self._known[next(iter(self._known))]

    def _tell(self) -> None:
        self._patience.stop()
        self.current = True
        self.found.emit(self.findings)


def _inspected(
    blueprint: Blueprint, world: str, loaded: Loaded | None, robot: str
) -> tuple[Finding, ...]:
    """Inspect a blueprint, also in a world if there is one. The worker thread calls this."""
    found = inspect(blueprint)
    if not world:
        return found
    from smsl_studio.front.equipment import findings_in_world

    try:
        more = findings_in_world(blueprint, world, loaded=loaded, robot=robot)
    except (WorldError, UsageError):
        return found  # its plugin, or the robot's, is gone, and Run says so
    return in_order(blueprint, (*found, *more))


def _listed(blueprint: Blueprint) -> tuple[ClaimRow, ...]:
    """List the hazards and properties of a blueprint. It is called in the worker thread."""
    from smsl_studio.front.claim_rows import has_claims, unanswered

    return unanswered(blueprint) if has_claims(blueprint) else ()


def _answer(blueprint: Blueprint, tell: Callable[[int], object]) -> ClaimAnswers:
    """Answer the hazards and properties of a blueprint. It is called in the worker thread."""
    from smsl_studio.front.claim_rows import answered

    return answered(blueprint, LIMIT, tell)
