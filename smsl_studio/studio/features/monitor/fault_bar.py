"""The bar that injects a fault into the world on purpose: the fault and its parameters."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.errors import UsageError
from smsl_studio.front.views.fault_choices import EXAMPLE, parameters_of
from smsl_studio.studio.base.controls import Combo, Elided, Field, label
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital

WORDS = "Let something go wrong in the world"
NONE_HERE = "This world has no faults to inject"
NO_RUN = "Faults can be injected while a run is there"


class FaultBar(QWidget):
    """One line: the name of a fault, its parameters as in a script, and the button Inject."""

    wanted = Signal(str, object)
    """(fault, parameters)."""

    def __init__(self) -> None:
        super().__init__()
        self._shown: object = None
        self._who = Elided()
        self._refusal = label("", "refusal")
        self._refusal.setWordWrap(False)
        self.fault = Combo()
        self.fault.setAccessibleName("What goes wrong in the world")
        self.fault.setFixedWidth(150)
        self.parameters = Field()
        self.parameters.setPlaceholderText(EXAMPLE)
        self.parameters.setAccessibleName("With what")
        self.parameters.setFixedWidth(190)
        self.parameters.returnPressed.connect(self.inject)
        self.button = QPushButton("Inject")
        self.button.setToolTip("It is told in the record, with who injected it")
        self.button.setAutoDefault(False)
        self.button.clicked.connect(self.inject)
        across = QHBoxLayout(self)
        across.setContentsMargins(12, 8, 12, 8)
        across.setSpacing(8)
        across.addWidget(self._who, 1)
        for part in (self._refusal, self.fault, self.parameters, self.button):
            across.addWidget(part)
        self.show_faults((), False)

    def show_faults(self, names: tuple[str, ...], runs: bool) -> None:
        """Offer the faults of this world; ``runs`` says whether there is a run."""
        if (names, runs) == self._shown:
            return
        self._shown = names, runs
        self._who.setText(WORDS if runs and names else NONE_HERE if runs else NO_RUN)
        self.fault.clear()
        for name in names:
            self.fault.addItem(name.replace("_", " "), name)
        for part in (self.fault, self.parameters, self.button):
            part.setEnabled(runs and bool(names))
        self.refuse("")

    @property
    def refusal(self) -> str:
        """Why the last fault was not injected; empty if it was."""
        return self._refusal.text()

    def refuse(self, words: str) -> None:
        """Show why the fault was not injected."""
        self._refusal.setText(words)
        self._refusal.setVisible(bool(words))
        self._refusal.setToolTip(tip_text(words))
        self._who.setVisible(not words)

    def tell(self, fault: str, time: float) -> None:
        """Show that the fault was injected, and at which simulated second."""
        self.refuse("")
        self._who.setText(f"Injected: {fault.replace('_', ' ')}, at {time:.1f} s")

    @property
    def words(self) -> str:
        """The text at the left."""
        return self._who.text()

    def inject(self) -> None:
        """Ask for the chosen fault, if its parameters are valid."""
        try:
            parameters = parameters_of(self.parameters.text())
        except UsageError as error:
            self.refuse(capital(error.sentence))
            return
        self.refuse("")
        self.wanted.emit(self.fault.currentData(), parameters)
