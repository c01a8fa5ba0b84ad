"""The dialog that lets something go wrong in the world of a run: what, and when."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TypeVar

from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QDialog, QGridLayout, QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.errors import StudioError, UsageError
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.script.script import AT
from smsl_studio.front.script.words import WORDS
from smsl_studio.front.views.fault_choices import (
    AFTER,
    DISTURB,
    ELSEWHERE,
    EXAMPLE,
    INJECT,
    MOMENTS,
    NOW,
    SET,
    STUCK,
    Choice,
    FaultChoice,
    fact_choices,
    fault_choices,
    fault_line,
    operation_choices,
    parameters_of,
    undone_words,
    value_choices,
)
from smsl_studio.front.views.fault_effects import RIGHT, idle_words, later_words
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.regulation import Commanded, Disturbed, FaultInjected
from smsl_studio.studio.base.controls import Combo, Field, label, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital, counted
from smsl_studio.studio.features.run.choice_hold import ChoiceHold
from smsl_studio.studio.running.run_session import RunSession

NO_RUN = "A fault can be injected while a run is there"
NO_FAULTS = "This world has no faults to inject, and no sensors to disturb"
DONE = (INJECT, DISTURB)
MOST = 300
"""The largest number of characters of a line that is shown; the tooltip has more."""
Line = TypeVar("Line", bound=QWidget)
NEXT = "The next operation is not known now. Choose Now, or choose an operation by hand first"


class FaultDialog(QDialog):
    """A non-modal dialog about the present run of its window. It holds the run while one chooses.

    What is offered first always changes something.
    """

    def __init__(self, run: RunSession, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Inject a fault")
        self._run = run
        self._offered: tuple[object, ...] = ()
        self._of: object = None
        self._chosen: set[Combo] = set()
        """The fields in which the person has chosen."""
        self._offering = False
        self.hold = ChoiceHold(run)
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(8)
        self._grid.setColumnStretch(1, 1)
        self._lines: dict[QWidget, QWidget] = {}
        self.fault = self._choice("What goes wrong")
        self.fact = self._choice("Fact")
        self.value = self._choice("Value")
        self.state = self._choice("State")
        self.parameters = self._line("With", Field())
        self.parameters.setPlaceholderText(EXAMPLE)
        self.moment = self._choice("When")
        for name, words in MOMENTS.items():
            self.moment.addItem(words, name)
        self.operation = self._choice("Operation")
        self.script = label("", "mono")
        self.script.setWordWrap(True)
        self.script.setAccessibleName("The same as a line of a script")
        self.refusal, self.said = label("", "refusal"), label("", "hint")
        self.undone = label("", "hint")
        self.waiting = label("", "small")
        self.waiting.setWordWrap(True)
        self.back = QPushButton("Take back")
        self.back.setToolTip("No fault that still waits for its moment is injected")
        self.close_button, self.inject = QPushButton("Close"), QPushButton("Inject")
        self._build()
        self.fault.currentIndexChanged.connect(self._show_fault)
        self.fact.currentIndexChanged.connect(self._offer_values)
        for combo in (self.value, self.state, self.moment, self.operation):
            combo.currentIndexChanged.connect(lambda _, own=combo: self._choose(own))
            combo.activated.connect(lambda _, own=combo: self._chosen.add(own))
        self.parameters.textChanged.connect(self._show_line)
        run.changed.connect(self.refresh)
        run.exists_changed.connect(lambda _: self.refresh())
        run.events_told.connect(self._hear)

    def _build(self) -> None:
        for button in (self.back, self.close_button):
            button.setAutoDefault(False)
        self.inject.setDefault(True)
        self.inject.clicked.connect(self.ask)
        self.back.clicked.connect(self._take_back)
        self.close_button.clicked.connect(self.close)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(12)
        column.addWidget(self.hold)
        column.addLayout(self._grid)
        column.addWidget(label("As a line of a script", "label"))
        column.addWidget(self.script)
        column.addWidget(self.undone)
        column.addWidget(self.refusal)
        column.addWidget(self.said)
        column.addLayout(row(self.waiting, None, self.back))
        column.addStretch(1)
        column.addLayout(row(None, self.close_button, self.inject))
        open_at(self, 460, 420)

    def _choice(self, words: str) -> Combo:
        combo = Combo()
        self._line(words, combo)
        return combo

    def _line(self, words: str, field: Line) -> Line:
        said = label(words, "label")
        said.setBuddy(field)
        field.setAccessibleName(words)
        at = self._grid.rowCount()
        self._grid.addWidget(said, at, 0)
        self._grid.addWidget(field, at, 1)
        self._lines[field] = said
        return field

    # What is offered.

    def showEvent(self, event: QShowEvent) -> None:
        """Offer what can be chosen now."""
        super().showEvent(event)
        if not event.spontaneous():
            self._chosen.clear()
            self.said.setText("")
            self.refresh()
            self.fault.setFocus()

    def hideEvent(self, event: QHideEvent) -> None:
        """Let the run go on that was held for the choice."""
        super().hideEvent(event)
        if not event.spontaneous():
            self.hold.end()

    def leave(self) -> None:
        """Close, and leave the run as it is."""
        self.hold.forget()
        self.close()

    def refresh(self) -> None:
        """Offer the faults of this run and the operations that may come next."""
        run, blueprint, status = self._run, self._run.blueprint, self._run.status
        if not self.isVisible():
            return
        there = run.exists and blueprint is not None and status is not None
        there = there and bool(run.faults or run.sensors)
        for field in self._lines:
            field.setEnabled(there)
        self.inject.setEnabled(there)
        if not there or blueprint is None or status is None:
            self._refuse(NO_FAULTS if run.exists and status is not None else NO_RUN)
            self._show_waiting()
            return
        anew, self._of = self._of is not run.choice, run.choice
        if self._offered != (blueprint, run.faults):
            self._offered = blueprint, run.faults
            self._refuse("")
            _fill(self.fact, fact_choices(blueprint))
            states = [(f"{sb.name}/{name}" if len(blueprint) > 1 else name, f"{sb.name}/{name}")
                      for sb in blueprint for name in sb.table]  # fmt: skip
            _fill(self.state, states)
            _fill(self.fault, fault_choices(run.faults, bool(run.sensors)))
            self._offer_values()
            self._show_fault()
        elif self.refusal.text() == NO_RUN:
            self._refuse("")
        if not self.operation.view().isVisible():
            _fill(self.operation, operation_choices(blueprint, status))
            if anew:
                # What was chosen in the run before can lie far ahead in this one.
                self.operation.setCurrentIndex(0)
        self.operation.setEnabled(self.moment.currentData() != NOW)
        self._show_line()
        self._show_waiting()

    def _offer_values(self) -> None:
        blueprint, key = self._run.blueprint, self.fact.currentData()
        if blueprint is not None and key is not None:
            self._chosen.discard(self.value)
            _fill(self.value, value_choices(blueprint, key))
            self._show_line()

    def _show_fault(self) -> None:
        """Show the fields of the chosen fault."""
        do, kind = self.fault.currentData() or (INJECT, "")
        own = do == INJECT and SET not in self._run.faults
        shown = {
            self.fact: do == DISTURB or (kind == SET and not own),
            self.value: kind in (SET, STUCK) and not own,
            self.state: kind == ELSEWHERE and not own,
            self.parameters: own,
        }
        for field, show in shown.items():
            field.setVisible(show)
            self._lines[field].setVisible(show)
        self._show_line()

    @property
    def chosen(self) -> FaultChoice:
        """The choice. UsageError if its parameters or its operation are missing."""
        do, kind = self.fault.currentData()
        moment, operation = self.moment.currentData(), self.operation.currentData()
        if moment != NOW and operation is None:
            raise UsageError(NEXT)
        given: dict[str, float | str] = {"fault": kind}
        if do == DISTURB:
            given = {"target": fact_text(*self.fact.currentData()), "kind": kind}
        elif not self.fact.isHidden():
            given["fact"] = fact_text(*self.fact.currentData())
        if not self.value.isHidden():
            given["value"] = self.value.currentData()
        if not self.state.isHidden():
            given["state"] = self.state.currentData()
        if not self.parameters.isHidden():
            given |= parameters_of(self.parameters.text())
        return FaultChoice(do, given, moment, operation)

    def _show_line(self) -> None:
        blueprint, status = self._run.blueprint, self._run.status
        self.operation.setEnabled(self.moment.currentData() != NOW and self.inject.isEnabled())
        if blueprint is None or status is None or not self.inject.isEnabled():
            self.script.setText("")
            return
        try:
            chosen = self.chosen
        except UsageError as error:
            self.script.setText("")
            self._refuse(capital(error.sentence))
            return
        if self._offer_other(chosen):
            return
        known = self._idle(chosen) or later_words(chosen, status, blueprint)
        self.undone.setText(capital(self._undone(chosen) or known))
        line = fault_line(chosen, status, blueprint, self._run.who())
        if self.refusal.text() not in (NO_RUN, NO_FAULTS):
            self._refuse("")
        words = json.dumps(line, ensure_ascii=False)
        if words != self.script.toolTip():
            self.script.setText(words if len(words) <= MOST else f"{words[:MOST]}…")
            self.script.setToolTip(tip_text(words))

    def _choose(self, combo: Combo) -> None:
        """Note that the person has chosen in a field, unless the dialog has."""
        if not self._offering:
            self._chosen.add(combo)
            self._show_line()

    def _offer_other(self, chosen: FaultChoice) -> bool:
        """Offer something else where the person has not chosen and nothing would change."""
        status, blueprint = self._run.status, self._run.blueprint
        if self._undone(chosen) and self.moment not in self._chosen:
            return self._offer(self.moment, self.moment.findData(AFTER))
        if status is None or blueprint is None:
            return False
        for combo in (self.value, self.state):
            if combo.isHidden() or combo in self._chosen:
                continue
            idle = self._idle(chosen) or later_words(chosen, status, blueprint)
            other = 1 if combo.currentIndex() == 0 else 0
            if idle and combo.count() > 1:
                return self._offer(combo, other)
        return False

    def _offer(self, combo: Combo, at: int) -> bool:
        self._offering = True
        combo.setCurrentIndex(at)
        self._offering = False
        self._show_line()
        return True

    def _undone(self, chosen: FaultChoice) -> str:
        status, choice = self._run.status, self._run.choice
        if status is None or choice is None:
            return ""
        return undone_words(chosen, status, choice.world)

    def _idle(self, chosen: FaultChoice) -> str:
        status, blueprint = self._run.status, self._run.blueprint
        if status is None or blueprint is None:
            return ""
        return idle_words(chosen, status, blueprint, self._disturbed())

    def _disturbed(self) -> set[FactKey]:
        """The facts that are read wrongly now, or will be."""
        kinds, run = self._run.story.moment.disturbed, self._run
        now = {(one.branch, one.digit) for one in run.sensors if kinds.get(one.name)}
        later = [split_fact(str(act.given.get("target", ""))) for act in run.planned
                 if act.do == DISTURB and act.given.get("kind") != RIGHT]  # fmt: skip
        return now.union(key for key in later if key is not None)

    # What is done.

    def ask(self) -> None:
        """Inject the fault now, or have it wait for its moment."""
        blueprint, status = self._run.blueprint, self._run.status
        if blueprint is None or status is None or not self._run.exists:
            return
        try:
            if idle := self._idle(self.chosen):
                raise UsageError(idle)
            line = fault_line(self.chosen, status, blueprint, self._run.who())
            (act,) = script_of(json.dumps(line).encode(), "line", blueprint).acts
        except StudioError as error:
            self._refuse(capital(error.sentence))
            return
        self._refuse("")
        if act.trigger.kind == AT:
            self._run.take(WORDS[act.do].command(act.given, act.by))
        else:
            self._run.plan(act)
            self.said.setText("It waits for its moment.")
        self._show_waiting()

    def _take_back(self) -> None:
        self._run.drop_plans()
        self.said.setText("")
        self._show_waiting()

    def _hear(self, events: tuple[Event, ...]) -> None:
        for event in events:
            if isinstance(event, FaultInjected):
                self._refuse("")
                self.said.setText(f"Injected at {event.t:.2f} s: {event.fault.replace('_', ' ')}.")
            elif isinstance(event, Disturbed):
                self._refuse("")
                self.said.setText(f"Disturbed at {event.t:.2f} s: {event.target} {event.kind}.")
            elif isinstance(event, Commanded) and event.command in DONE and event.refused:
                self._refuse(capital(event.refused))

    def _show_waiting(self) -> None:
        count = len(self._run.planned) if self._run.exists else 0
        self.waiting.setText(f"{counted(count, 'fault')} waiting for a moment" if count else "")
        self.back.setVisible(bool(count))

    def _refuse(self, words: str) -> None:
        if words != self.refusal.text():
            self.refusal.setText(words)
        self.refusal.setVisible(bool(words))


def _fill(combo: Combo, choices: Sequence[Choice]) -> None:
    """Replace the entries; the choice stays if it still exists."""
    held = [combo.itemText(at) for at in range(combo.count())]
    if held == [words for words, _ in choices]:
        return
    before = combo.currentData()
    blocked = combo.blockSignals(True)
    combo.clear()
    for words, value in choices:
        combo.addItem(words, value)
    found = [at for at, (_, value) in enumerate(choices) if value == before]
    combo.setCurrentIndex(found[0] if found else 0)
    combo.blockSignals(blocked)
