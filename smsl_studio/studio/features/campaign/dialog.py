"""The dialog New campaign: world, states, seeds, faults, supervisors, and who carries it out."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QIntValidator
from PySide6.QtWidgets import (
    QDialog,
    QGridLayout,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.front.campaign_faults import ALL, ROUTE
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, NameDelegate, label, name_parts, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import CONTROL
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.campaign.choice import CampaignChoice, CampaignOffer

EDGES = {"Those of a run without a fault": ROUTE, "All of the blueprint": ALL}
UNTIL = {"All seeds are run": None, "Each is at most 20 % wide": 0.2,
         "Each is at most 10 % wide": 0.1, "Each is at most 5 % wide": 0.05}  # fmt: skip
MOST_WORKERS = 64
TIPS = {
    "World": "Where the runs are carried out",
    "Seeds": "How many runs each fault has in each operation. A seed draws the jitter of the world",
    "Operations": "In which operations a fault is put in, once in each run",
    "Faults": "What goes wrong. Without a fault the runs are undisturbed",
    "Supervisors": "Automatic supervisors of each run, with a space between two",
    "Workers": "So many processes of this computer carry the runs out",
    "Dask": "A Dask scheduler, whose workers carry the runs out in place of processes here",
    "Intervals": "The campaign ends early when each 95 % interval is so narrow",
}


class CampaignDialog(QDialog):
    """Asks for a campaign. ``choice`` is what was chosen, as soon as it is accepted."""

    def __init__(self, choice: CampaignChoice, offer: CampaignOffer, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("New campaign")
        self.choice = offer.fitted(choice)
        self._offer, self._known = offer, offer.supervisors
        self.world, self.start, self.goal = Combo(), Combo(), Combo()
        for words, world, robot in offer.worlds:
            self.world.addItem(words, (world, robot))
        self._fill(self.start, offer.starts, self.choice.start)
        self._fill(self.goal, offer.goals, self.choice.goal)
        self.seeds = QLineEdit(str(self.choice.seeds))
        self.seeds.setValidator(QIntValidator(0, 9_999_999, self.seeds))
        self.edges, self.until = Combo(), Combo()
        self._fill(self.edges, tuple(EDGES.items()), self.choice.edges)
        self._fill(self.until, tuple(UNTIL.items()), self.choice.until)
        self.faults = QListWidget()
        self.faults.setProperty("role", "list")
        self.faults.setItemDelegate(NameDelegate(self.faults))
        self.agents = QLineEdit(" ".join(self.choice.agents))
        self.agents.setPlaceholderText("none, or such as limit:risk=0.5 forecast")
        self.workers = QSpinBox()
        self.workers.setRange(1, MOST_WORKERS)
        self.workers.setFixedHeight(CONTROL)
        self.workers.setValue(self.choice.workers)
        self.dask = QLineEdit(self.choice.dask)
        self.dask.setPlaceholderText("tcp://HOST:PORT, empty for this computer")
        self.refusal = label("", "refusal")
        self.refusal.setMinimumHeight(20)
        self.cancel, self.begin = QPushButton("Cancel"), QPushButton("Start")
        self.begin.setProperty("role", "primary")
        self.begin.setDefault(True)
        self._build()
        at = [one[1:] for one in offer.worlds].index((self.choice.world, self.choice.robot))
        self.world.setCurrentIndex(at)
        self._show_faults(self.choice.faults)
        self.world.currentIndexChanged.connect(lambda *_: self._show_faults(self._checked))
        self.seeds.textChanged.connect(lambda *_: self._judge())
        self.agents.textChanged.connect(lambda *_: self._judge())
        self.dask.textChanged.connect(lambda *_: self._judge())
        self.faults.itemChanged.connect(lambda *_: self._judge())
        self.cancel.clicked.connect(self.reject)
        self.begin.clicked.connect(self.accept)
        open_at(self, 640, 520)
        self._judge()

    def _build(self) -> None:
        named = (
            ("World", self.world, 0, 0), ("Seeds", self.seeds, 0, 2), ("Start", self.start, 1, 0),
            ("Goal", self.goal, 1, 2), ("Faults", self.faults, 2, 0),
            ("Operations", self.edges, 3, 0), ("Intervals", self.until, 4, 0),
            ("Supervisors", self.agents, 5, 0), ("Workers", self.workers, 6, 0),
            ("Dask", self.dask, 6, 2),
        )  # fmt: skip
        grid = QGridLayout()
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(8)
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(3, 1)
        grid.setRowStretch(2, 1)
        alone = {at for _, _, at, _ in named if sum(one[2] == at for one in named) == 1}
        for words, part, at, column in named:
            said = label(words, "second")
            said.setBuddy(part)
            top = (
                Qt.AlignmentFlag.AlignTop if part is self.faults else Qt.AlignmentFlag.AlignVCenter
            )
            grid.addWidget(said, at, column, top)
            grid.addWidget(part, at, column + 1, 1, 3 if at in alone else 1)
            part.setAccessibleName(words)
            part.setToolTip(tip_text(TIPS.get(words, f"The {words.lower()} of each run")))
        column_ = QVBoxLayout(self)
        column_.addLayout(grid, 1)
        column_.addWidget(self.refusal)
        column_.addLayout(row(None, self.cancel, self.begin, spacing=8))
        name_parts(self)

    @staticmethod
    def _fill(combo: Combo, pairs: tuple[tuple[str, object], ...], chosen: object) -> None:
        for words, data in pairs:
            combo.addItem(words, data)
        combo.setCurrentIndex(max([data for _, data in pairs].index(chosen), 0))

    @property
    def _checked(self) -> tuple[str, ...]:
        """The faults that are checked."""
        items = (self.faults.item(at) for at in range(self.faults.count()))
        return tuple(
            one.data(Qt.ItemDataRole.UserRole)
            for one in items
            if one.checkState() is Qt.CheckState.Checked
        )

    def _show_faults(self, checked: tuple[str, ...]) -> None:
        """Offer the faults of the chosen world; those that were checked stay so."""
        blocked = self.faults.blockSignals(True)
        self.faults.clear()
        for name in self._offer.faults(self.world.currentData()[0]):
            item = QListWidgetItem(plain_text(name.replace("_", " ")))
            item.setData(Qt.ItemDataRole.UserRole, name)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            on = name in checked or ALL in checked
            item.setCheckState(Qt.CheckState.Checked if on else Qt.CheckState.Unchecked)
            self.faults.addItem(item)
        self.faults.blockSignals(blocked)
        self._judge()

    def _chosen(self) -> CampaignChoice:
        """What stands in the fields. All faults are ``all``, which leaves out what does not fit."""
        world, robot = self.world.currentData()
        faults = self._checked
        return CampaignChoice(
            world=world,
            robot=robot,
            start=self.start.currentData(),
            goal=self.goal.currentData(),
            seeds=int(self.seeds.text() or 0),
            faults=(ALL,) if faults and len(faults) == self.faults.count() else faults,
            edges=self.edges.currentData(),
            agents=tuple(self.agents.text().split()),
            workers=self.workers.value(),
            dask=self.dask.text().strip(),
            until=self.until.currentData(),
        )

    def _judge(self) -> None:
        """Say what is wrong, before anything is begun with it."""
        wrong = self._chosen().fault(self._known)
        self.refusal.setText(wrong)
        self.begin.setEnabled(not wrong)

    def accept(self) -> None:
        """Take over what was chosen."""
        self.choice = self._chosen()
        super().accept()
