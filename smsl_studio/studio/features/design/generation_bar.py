"""The bar about a new generation: who is asked, what came, and whether it is taken."""

from __future__ import annotations

from time import monotonic

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout

from smsl_studio.front.design.generation import BLUEPRINT, OTHER, NewGeneration
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted


class GenerationBar(QFrame):
    """Hidden as long as nothing is generated. It has at most two buttons."""

    cancel_wanted, take_wanted, leave_wanted, again_wanted = Signal(), Signal(), Signal(), Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setProperty("role", "float")
        self.setAccessibleName("New generation")
        self.words = label("", "second")
        self.words.setWordWrap(True)
        self.cancel = self._button("Cancel", "Ask nobody any more", self.cancel_wanted)
        self.take = self._button(
            "Take it", "Replace the blueprint; what you changed by hand stays. Ctrl+Z takes it "
            "back", self.take_wanted)  # fmt: skip
        self.take.setProperty("role", "primary")
        self.leave = self._button("Leave it", "Keep the blueprint as it is", self.leave_wanted)
        self.again = self._button("Ask again", "Look for the missing answer", self.again_wanted)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 8, 12, 8)
        column.setSpacing(6)
        column.addWidget(self.words)
        column.addLayout(row(self.take, self.again, self.cancel, self.leave, None))
        self._who, self._since = "", 0.0
        self._clock = QTimer(self)
        self._clock.setInterval(1000)
        self._clock.timeout.connect(self._tell)
        self.hide()

    def _button(self, words: str, tip: str, wanted: object) -> QPushButton:
        made = QPushButton(words)
        made.setAutoDefault(False)
        made.setToolTip(tip_text(tip))
        made.clicked.connect(wanted)
        return made

    def show_asking(self, who: str) -> None:
        """Show who is asked, and for how long already."""
        self._who, self._since = who, monotonic()
        self._offer(self.cancel)
        self._tell()
        self._clock.start()

    def show_refusal(self, words: str) -> None:
        """Show why nothing came."""
        self._offer(self.leave)
        self.words.setText(words)

    def show_came(self, new: NewGeneration) -> None:
        """Show what came: differences, or what is missing."""
        lacking = " ".join(f"{words}. {advice}" for words, advice in new.made.lacking)
        if not new.is_whole:
            self._offer(self.again, self.leave)
            self.words.setText(lacking or "Nothing came.")
            return
        many = counted(len(new.changes), "difference") if new.changes else "no difference"
        if new.place == OTHER:
            name = new.request.target.name
            many = f"{name} is there already and is no blueprint, so it goes to a folder former-1"
        said = f"A new generation waits: {many}. The blueprint is as before until you take it."
        if new.place == BLUEPRINT and new.changes and not new.has_base:
            said += " Nothing tells what you changed by hand, so all of it is replaced."
        if new.made.doubts:
            said += f" Look again at {counted(len(new.made.doubts), 'point')}."
        if not new.made.goal_reached:
            said += " Its goal is not reached."
        self._offer(self.take, self.leave)
        self.words.setText(f"{said} {lacking}".strip())

    def close_bar(self) -> None:
        """Hide the bar."""
        self._clock.stop()
        self.hide()

    def _offer(self, *buttons: QPushButton) -> None:
        self._clock.stop()
        for one in (self.take, self.again, self.cancel, self.leave):
            one.setVisible(one in buttons)
        self.show()

    def _tell(self) -> None:
        seconds = int(monotonic() - self._since)
        self.words.setText(
            f"Asking {self._who}… {seconds} s" if seconds else f"Asking {self._who}…"
        )
