"""The facts that are chosen in Supervise: one choice, which scene, text, graph and table show."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.partial import PartialView
from smsl_studio.front.views.things import Facts, changes_of, facts_of_things
from smsl_studio.studio.features.supervise.board import Board
from smsl_studio.studio.features.supervise.text_panel import TextPanel
from smsl_studio.studio.running.facts_table import FactsTable
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.world_pane import WorldPane

NOTHING: Facts = frozenset()


class FactChoice(QObject):
    """``keys`` are the chosen facts. What is chosen again is chosen no more."""

    changed = Signal()

    def __init__(
        self, run: RunSession, board: Board, text: TextPanel, scene: WorldPane, table: FactsTable
    ) -> None:
        super().__init__(board)
        self._run, self._board, self._text = run, board, text
        self._scene, self._table = scene, table
        self._things: dict[str, Facts] = {}
        self._known: tuple[object, ...] = ()
        self._view: PartialView | None = None
        self.keys = NOTHING
        table.named.connect(lambda key: self.choose(frozenset((key,))))
        scene.tiles.chosen.connect(lambda key: self.choose(frozenset((key,))))
        scene.view.thing_chosen.connect(lambda name: self.choose(self._things.get(name, NOTHING)))
        board.state_chosen.connect(self.choose_state)

    @property
    def things(self) -> frozenset[str]:
        """The names of the things in the scene that the chosen facts are about."""
        return frozenset(name for name, keys in self._things.items() if keys & self.keys)

    def choose(self, keys: Facts) -> None:
        """Choose these facts in place of others; none if they are chosen already."""
        self.keys = NOTHING if keys == self.keys else keys
        self.changed.emit()

    def choose_state(self, state: str) -> None:
        """Choose the facts that are otherwise in a state than in the active one; of the active
        state all."""
        blueprint, view = self._run.blueprint, self._view
        if blueprint is None or view is None or state not in blueprint[view.branch].table:
            return
        if state == view.state:
            count = len(blueprint[view.branch].facts(state))
            self.choose(frozenset((view.branch, digit) for digit in range(count)))
        else:
            self.choose(changes_of(blueprint, view.branch, view.state, state))

    def choose_changed(self, edge: Address) -> None:
        """Choose the facts that an operation changes."""
        blueprint = self._run.blueprint
        if blueprint is not None:
            target = blueprint[edge.branch].table[edge.state][edge.operation]
            self.keys = changes_of(blueprint, edge.branch, edge.state, target)
            self.changed.emit()

    def follow(self, status: DispatchStatus | None, view: PartialView | None) -> None:
        """Show the choice in a run that stands so."""
        run, blueprint, self._view = self._run, self._run.blueprint, view
        if blueprint is None or status is None or view is None:
            self.keys, self._things, self._known = NOTHING, {}, ()
        elif (now := (id(blueprint), id(run.shapes), len(status.sources))) != self._known:
            self._known = now
            sources = [(one.fact, one.said.source) for one in status.sources]
            names = [shape.name for shape in run.shapes]
            self._things = facts_of_things(blueprint, sources, names)
        self._scene.view.offer_things(frozenset(self._things))
        self._scene.view.show_chosen(self.things)
        self._scene.tiles.show_chosen(self.keys)
        self._table.show_chosen(self.keys)
        changing = self._changing(blueprint, view)
        self._text.show_changing(changing)
        targets = (card.target for card in view.cards if card.name in changing) if view else ()
        self._board.show_selected(frozenset(targets))

    def _changing(self, blueprint: Blueprint | None, view: PartialView | None) -> dict[str, str]:
        """Return the operations of the active state that change a chosen fact, with words."""
        found: dict[str, str] = {}
        for card in view.cards if blueprint is not None and view is not None else ():
            assert blueprint is not None
            address = card.address
            changed = changes_of(blueprint, address.branch, address.state, card.target)
            names = [_name(blueprint, key) for key in sorted(changed & self.keys)]
            if names:
                found[card.name] = f"changes {', '.join(names)}"
        return found


def _name(blueprint: Blueprint, key: FactKey) -> str:
    return blueprint[key[0]].fact_name(key[1])
