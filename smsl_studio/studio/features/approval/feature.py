"""The feature Approval. Its badge shows the approval of the open blueprint."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.project import project_of
from smsl_studio.errors import StudioError
from smsl_studio.front.approval_badge import (
    LOOKING,
    ApprovalWords,
    approval_words,
    unsigned_words,
)
from smsl_studio.front.former_record import approval_stamps, has_record_beside, may_have_record
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Feature
from smsl_studio.studio.base.file_dialogs import ask_to_open, ask_to_save
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.features.approval.badge import ApprovalBadge
from smsl_studio.studio.features.approval.reason_card import ReasonCard
from smsl_studio.studio.features.approval.store_watch import StoreWatch
from smsl_studio.studio.running.window_parts import WindowParts

IDLE = 400
"""The record is verified after this time without an edit (milliseconds)."""
WATCH = 2000
"""The time between two looks at the files of the approval (milliseconds)."""
BUNDLES = "Evidence (*.zip)"
POLICIES = "Trust policies (*.toml);;All files (*)"

SIGNATURES = "Signatures"
"""The submenu of the menu Blueprint."""


class ApprovalFeature(Feature):
    """The badge of trust, and the trust policy of the project.

    A second thread verifies the signatures. Until the result is known, the border is dashed, and
    the badge says that the check is running. ``compare`` shows what has changed since the last
    signature.
    """

    def __init__(self, parts: WindowParts) -> None:
        self._session, self._files, self._settings = parts.session, parts.files, parts.settings
        self._window, self._toast = parts.window, parts.toast
        self.badge = ApprovalBadge(parts.tokens)
        self.badge.clicked.connect(self.show)
        self.badges = (self.badge,)
        self.compare: Callable[[], None] = lambda: None
        self.told: Callable[[ApprovalWords], None] = lambda said: None
        """Hears what the badge says, whenever it says something else."""
        self.ask_file: Callable[[Path], Path | None] = self._asked
        self.store = StoreWatch(parts.window)
        self.ask_bundle: Callable[[Path], Path | None] = self._asked_bundle
        self._beside = Beside(parts.window)
        self._export = Beside(parts.window)
        """Not dropped at the next edit, other than ``_beside``."""
        self._later = QTimer(parts.window)
        self._later.setSingleShot(True)
        self._later.setInterval(IDLE)
        self._later.timeout.connect(self._look)
        self.card: ReasonCard | None = None
        self._seen = self._stamps()
        self._watch = QTimer(parts.window)
        self._watch.setInterval(WATCH)
        self._watch.timeout.connect(self._look_outside)
        self._watch.start()
        parts.session.blueprint_changed.connect(lambda *_: self._wait())
        parts.files.changed.connect(lambda *_: self._wait())
        self._wait()

    @property
    def policy(self) -> Path | None:
        """The trust policy of the project to which the open file belongs; None without one."""
        return self._settings.policy_of(project_of(self._session.blueprint.file))

    def actions(self) -> tuple[Action, ...]:
        """The commands in the menu Blueprint about signatures."""
        return (
            Action("approval_reasons", "Who has signed this", self.show, "Blueprint", "", (),
                   lambda: not self.badge.isHidden(), section=4, inner=SIGNATURES,
                   tip="Whether the blueprint is approved, and why not"),
            Action("compare_signed", "Compare with the last signature", lambda: self.compare(),
                   "Blueprint", "", (), self._may_be_signed, section=4, inner=SIGNATURES,
                   tip="Show on the drawing what changed since somebody signed; removals first"),
            Action("choose_policy", "Choose a trust policy…", self.choose_policy, "Blueprint", "",
                   (), section=4, inner=SIGNATURES,
                   tip="Which signatures a run of this project needs"),
            Action("export_evidence", "Export evidence…", self.export, "Blueprint", "", (),
                   lambda: bool(self._session.blueprint.file), section=4, inner=SIGNATURES,
                   tip="Write the blueprint, its record, its recorded runs and a program that "
                       "checks them into one file"),
            Action("drop_policy", "Use no trust policy", self.drop_policy, "Blueprint", "", (),
                   lambda: self.policy is not None, section=4, inner=SIGNATURES,
                   tip="Let runs of this project start without signatures, in simulation"),
        )  # fmt: skip

    def show(self) -> None:
        """Show the reasons below the badge."""
        self.card = ReasonCard(self.badge.window(), self.badge.said, self.policy)
        self.card.policy_wanted.connect(self.choose_policy)
        self.card.none_wanted.connect(self.drop_policy)
        self.card.changes_wanted.connect(lambda: self.compare())
        self.card.open_below(self.badge)

    def look_again(self) -> None:
        """Verify the record again, because somebody has signed."""
        self._wait()

    def choose_policy(self) -> None:
        """Ask for the trust policy of the project. Runs start only if it is met."""
        file = self._session.blueprint.file
        chosen = self.ask_file(Path(project_of(file)))
        if chosen is not None:
            self._settings.choose_policy(project_of(file), chosen.absolute())
            self._toast.say(f"Runs of this project need the signatures that {chosen.name} asks for")
            self._wait()

    def export(self) -> None:
        """Ask for a file, and write the evidence there: what was signed, and the runs of it."""
        if self._files.unsaved:
            self._toast.say("Save the blueprint first. The evidence is about what is saved")
            return
        blueprint = self._session.blueprint
        chosen = self.ask_bundle(Path(blueprint.file).with_suffix(".zip"))
        if chosen is not None:
            folder = self._settings.recordings
            self._toast.say("The evidence is put together")
            work = partial(_exported, blueprint, chosen, folder, self.policy)
            self._export.do(work, self._toast.say)

    def drop_policy(self) -> None:
        """Let runs of the project start without signatures."""
        self._settings.choose_policy(project_of(self._session.blueprint.file), None)
        self._toast.say("Runs of this project need no signatures. They are simulations only")
        self._wait()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.badge.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._watch.stop()
        self.store.stop()
        self._later.stop()
        self._beside.stop()
        self._export.stop()

    def _may_be_signed(self) -> bool:
        return may_have_record(self._session.blueprint.file)

    def _asked(self, folder: Path) -> Path | None:
        name = ask_to_open(self._window, "Choose a trust policy", str(folder), POLICIES)
        return Path(name) if name else None

    def _asked_bundle(self, suggested: Path) -> Path | None:
        name, _ = ask_to_save(self._window, "Export evidence", str(suggested), BUNDLES)
        if not name:
            return None
        return Path(name) if Path(name).suffix else Path(f"{name}.zip")

    def _wait(self) -> None:
        """Verify the record again once the person has made no edit for ``IDLE`` milliseconds.

        Most files have no record and no policy. Then there is nothing to verify, and the badge says
        so at once.
        """
        self._beside.drop()
        self._seen = self._stamps()
        if self.policy is None and not has_record_beside(self._session.blueprint.file):
            self._later.stop()
            self._show(unsigned_words(self._session.blueprint))
            return
        self._show(LOOKING)
        self._later.start()

    def _look_outside(self) -> None:
        """Verify again if somebody has signed, revoked or changed the policy meanwhile."""
        seen = self._stamps()
        if seen != self._seen:
            self._wait()

    def _stamps(self) -> tuple[object, ...]:
        return approval_stamps(self._session.blueprint.file, self.policy)

    def _look(self) -> None:
        work = partial(approval_words, self._session.blueprint, self.policy)
        self._beside.do(work, self._show)

    def _show(self, said: ApprovalWords) -> None:
        self.badge.show_words(said)
        self.told(said)


def _exported(blueprint: Blueprint, chosen: Path, recordings: Path, policy: Path | None) -> str:
    """Write the bundle with the recorded runs of the blueprint; return what is told about it."""
    from smsl_studio.front.bundles import bundle
    from smsl_studio.front.evidence_runs import runs_of

    try:
        runs = runs_of(blueprint, recordings)
        bundle(blueprint, chosen, logs=runs, policy=policy)
    except StudioError as error:
        return refusal_words(error)
    many = counted(len(runs), "recorded run", "recorded runs")
    return f"{chosen.name} has the evidence, with {many}"
