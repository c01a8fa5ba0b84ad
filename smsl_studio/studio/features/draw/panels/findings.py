"""The list of findings. A click goes to the element, a button applies the fix."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import QModelIndex, Qt, QTimer, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QScrollArea, QStackedWidget, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.repair import Repair, certain_errors, mend, mend_errors
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.beside import Beside, Tally
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital, counted
from smsl_studio.studio.document.broken import Broken, faults_of
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.finding_rows import FindingsView, named
from smsl_studio.studio.features.draw.panels.fix_list import FixList
from smsl_studio.studio.features.draw.panels.frame import Panel
from smsl_studio.studio.features.draw.panels.unfinished import sum_of, to_finish

MOST = 6
"""The panel lists this many faults of a broken text; the source marks all of them."""

ASKED = "ask"
"""Stands in place of the rule at a comment of a review."""
SHOWN = 50
"""Milliseconds between two looks at how many fixes were found."""
PROVING = "Hazards and properties are not answered yet"
NOTHING = "Nothing is drawn yet, so nothing was checked. Add the first state."


class Findings(Panel):
    """The list of findings. ``tools`` stands at the right of its tab: the summary and “Fix all”."""

    count_changed = Signal(int)
    claim_wanted = Signal(object)
    """Address: the finding is about this hazard or property, which stands on no canvas."""
    asked_wanted = Signal(object)
    """Finding: a comment of a review, which somebody wants to answer."""
    check_wanted = Signal()
    """Show what is missing in an unfinished drawing as mistakes."""

    def __init__(
        self, session: Session, tokens: Tokens, rules: int = 0, parent: QWidget | None = None
    ) -> None:
        super().__init__("Findings", parent)
        self._session, self._rules, self._tokens = session, rules, tokens
        self._findings: tuple[Finding, ...] = ()
        self._broken: Broken | None = None
        self.draft = False
        """Whether the drawing is unfinished, so that nothing speaks of approval."""
        self.proving = False
        """Whether the findings of hazards and properties are still missing."""
        self.summary = Elided("Not checked yet")
        self.summary.setProperty("role", "small")
        self.fix_all_button = QPushButton("Fix all")
        self.fix_all_button.setProperty("role", "soft")
        self.fix_all_button.clicked.connect(self.fix_all)
        self.fix_all_button.hide()
        self.check_button = QPushButton("Check")
        self.check_button.setProperty("role", "soft")
        self.check_button.setToolTip("Show what is missing as the check does")
        self.check_button.clicked.connect(self.check_wanted)
        self.check_button.hide()
        self.list = FindingsView(tokens, self)
        self.empty: QLabel = label("", "hint")
        self.empty.setContentsMargins(16, 12, 16, 12)
        self.empty.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._pages = QStackedWidget()
        self._told = QScrollArea()
        self._told.setWidgetResizable(True)
        self._told.setFrameShape(QScrollArea.Shape.NoFrame)
        self._told.setWidget(self.empty)
        self._pages.addWidget(self._told)
        self._pages.addWidget(self.list)
        self.column.addWidget(self._pages)
        self.tools = QWidget()
        self.fix_button = QPushButton("Fix it")
        self.fix_button.setProperty("role", "soft")
        self.fix_button.clicked.connect(self.fix_current)
        self.fix_button.hide()
        self.list.selectionModel().currentChanged.connect(lambda *_: self._offer_fix())
        line = row(
            self.summary, self.check_button, self.fix_button, self.fix_all_button, spacing=12
        )
        line.setContentsMargins(0, 0, 8, 0)
        self.tools.setLayout(line)
        self.list.clicked.connect(self._jump)
        self.list.activated.connect(self._jump)
        self.list.fix_wanted.connect(self.fix)
        self._beside, self._tally = Beside(self), Tally()
        # Shows how many fixes were found, while they are computed.
        self._clock = QTimer(self, interval=SHOWN)
        self._clock.timeout.connect(self._show_mended)
        self._mending: Blueprint | None = None
        """The blueprint for which a worker thread computes “Fix all”, or None."""
        session.blueprint_changed.connect(lambda *_: self._drop_mending())
        self.set_checking()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.list.set_tokens(tokens)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings that are listed."""
        return self._findings

    @property
    def chosen_rule(self) -> str:
        """The rule of the chosen finding, such as ``R15``; empty if none is chosen."""
        finding = self.list.currentIndex().data(Qt.ItemDataRole.UserRole)
        return finding.rule if isinstance(finding, Finding) else ""

    def set_checking(self) -> None:
        """Say that the inspection is running, because the blueprint has changed."""
        if self._broken is not None:
            return
        self.summary.setText("Checking")
        if not self._findings:
            self.empty.setText("Not checked yet. The findings come in a moment.")

    def forget(self) -> None:
        """Remove the findings, because another file was opened."""
        self._findings = ()
        self.list.show_findings(())
        self.fix_all_button.hide()
        self.check_button.hide()
        self._pages.setCurrentWidget(self._told)
        self.count_changed.emit(0)
        self.set_checking()

    def set_broken(self, broken: Broken | None) -> None:
        """List the faults of a text that cannot be read. None lists the findings again."""
        self._broken = broken
        if broken is None:
            self.set_findings(self._findings)
            self.set_checking()
            return
        self._pages.setCurrentWidget(self._told)
        self.empty.setText(_faults_told(broken))
        self.summary.setText("The text cannot be read")
        self.fix_all_button.hide()
        self.check_button.hide()
        self.count_changed.emit(len(broken.error.faults))

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Show the findings of the blueprint as it is now, errors first."""
        self._findings = tuple(sorted(findings, key=_gravest_first))
        if self._broken is not None:
            return
        self.list.show_findings(self._findings)
        errors = sum(f.severity is Severity.ERROR for f in findings)
        rules = counted(self._rules, "rule")
        drawn = self._session.blueprint.state_count > 0
        self.check_button.setVisible(any(map(to_finish, findings)))
        self.summary.setText(
            sum_of(findings) if self.draft and findings else
            f"{counted(errors, 'error blocks', 'errors block')} approval" if errors else
            PROVING if self.proving else
            f"Checked, {rules}" if drawn else "Nothing to check"
        )  # fmt: skip
        said = f"No findings. {rules} checked."
        self.empty.setText(f"{said} {PROVING}." if self.proving else said if drawn else NOTHING)
        self._pages.setCurrentWidget(self.list if findings else self._told)
        self._offer_fixes()
        self.count_changed.emit(len(self._findings))

    def next_finding(self) -> None:
        """Go to the next finding; after the last one, to the first."""
        self.check_wanted.emit()
        if self._findings:
            at = self.list.currentIndex().row()
            index = self.list.model().index((at + 1) % len(self._findings), 0)
            self.list.setCurrentIndex(index)
            self._jump(index)

    def fix_current(self) -> None:
        """Apply the fix of the current finding, or else the first fix that is certain.

        A fix that deletes or guesses is only shown if its finding is not current; the next call
        applies it.
        """
        at = self.list.currentIndex().row()
        current = self._findings[at] if 0 <= at < len(self._findings) else None
        if current is not None and current.fix is not None:
            self.fix(current)
            return
        fixable = [f for f in self._findings if f.fix is not None]
        certain = next((f for f in fixable if f.fix is not None and f.fix.certain), None)
        if certain is not None:
            self.fix(certain)
        elif fixable:
            index = self.list.model().index(self._findings.index(fixable[0]), 0)
            self.list.setCurrentIndex(index)
            self._jump(index)

    def fix_all(self) -> None:
        """List the certain fixes of errors in a dialog, which makes them if the person agrees.

        A worker thread computes them one after the other, each on the blueprint that the last one
        left. Until it is done, the same button cancels it.
        """
        if self._mending is not None:
            self._drop_mending()
            return
        self._mending, self._tally = self._session.blueprint, Tally()
        self._show_mended()
        self._clock.start()
        self.fix_all_button.setToolTip("Cancel; nothing has been changed yet")
        work = partial(mend_errors, self._mending, self._tally.tell)
        self._beside.do(work, partial(self._list_fixes, self._mending))

    def _show_mended(self) -> None:
        fixes = self._tally.count
        found = f", {fixes} so far" if fixes else ""
        self.fix_all_button.setText(f"Computing the fixes{found}. Cancel")

    def _end_mending(self) -> None:
        self._mending = None
        self._clock.stop()
        self._offer_fixes()

    def _drop_mending(self) -> None:
        if self._mending is not None:
            self._beside.drop()
            self._end_mending()

    def _offer_fix(self) -> None:
        """Show the fix of the chosen finding as a button, so that it is found without a pointer."""
        finding = self.list.currentIndex().data(Qt.ItemDataRole.UserRole)
        fix = finding.fix if isinstance(finding, Finding) else None
        self.fix_button.setVisible(fix is not None)
        if fix is not None:
            self.fix_button.setAccessibleName(plain_text(f"Fix: {fix.words}"))
            self.fix_button.setToolTip(tip_text(f"{fix.words} (Ctrl+.)"))

    def _offer_fixes(self) -> None:
        self._offer_fix()
        if self._mending is not None:
            return
        fixes = len(certain_errors(self._findings))
        self.fix_all_button.setVisible(fixes > 1)
        self.fix_all_button.setText("Fix both…" if fixes == 2 else f"Fix all {fixes:,}…")
        self.fix_all_button.setToolTip(
            "List the certain fixes of errors, and make them if you agree"
        )

    def _list_fixes(self, blueprint: Blueprint, repair: Repair) -> None:
        if blueprint is not self._mending:
            return
        self._end_mending()
        if repair.mended:
            errors = [f for f in self._findings if f.fix and f.severity is Severity.ERROR]
            left = len(errors) - len(certain_errors(errors))
            FixList(self._session, repair, left, self._tokens, self.window()).open()

    def can_fix(self) -> bool:
        """Whether any finding has a fix."""
        return any(finding.fix is not None for finding in self._findings)

    def fix(self, finding: Finding) -> None:
        """Apply the fix of a finding as one undoable edit."""
        fix = finding.fix
        if fix is not None and self._session.edit(fix.words, partial(mend, finding=finding)):
            self._session.show_branch(finding.address.branch)
            announce(self, f"Done: {fix.words}. {named(finding)}, {finding.address}.")

    def _jump(self, index: QModelIndex) -> None:
        finding: Finding = index.data(Qt.ItemDataRole.UserRole)
        if finding.rule == ASKED:
            self.asked_wanted.emit(finding)
        elif finding.address.branch in ("_hazards", "_properties"):
            self.claim_wanted.emit(finding.address)
        else:
            self._session.jump(finding.address)
        # The keys are on the drawing now, so the finding itself is read out.
        announce(self, index.data(Qt.ItemDataRole.AccessibleTextRole))


def _faults_told(broken: Broken) -> str:
    """The faults of a broken text, one line each."""
    faults = broken.error.faults
    lines = [f"{faults_of(broken)}. The findings are listed again when the text can be read."]
    for fault in faults[:MOST]:
        place = f"Line {fault.place.line}, column {fault.place.column}: " if fault.place else ""
        lines.append(f"{place}{capital(fault.sentence)} {fault.advice}".rstrip())
    if len(faults) > MOST:
        lines.append(f"and {counted(len(faults) - MOST, 'more fault', 'more faults')}")
    return "\n".join(lines)


def _gravest_first(finding: Finding) -> int:
    return "EWI".index(finding.severity.value)
