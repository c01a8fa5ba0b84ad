"""Which generated functions count in a world: those that have passed their sweep there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import PluginError
from smsl_studio.library.bound import BindingFault
from smsl_studio.library.generated_trials import FunctionTrial, Key, read_trials
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.operation_entry import OperationEntry


class GeneratedOffers:
    """Says of one world whether a generated function is offered. In a ``trial`` all of them are,
    and in ``hardware`` none is."""

    def __init__(self, world: str, hardware: bool = False, trial: bool = False) -> None:
        self._world, self._hardware, self._trial = world, hardware, trial
        self._told: set[str] = set()

    def offers(self, entry: OperationEntry, edge: Address, target: str) -> bool:
        """Return whether a function is offered for an edge. PluginError, with the reason, if it is
        the first edge for which this function is not."""
        try:
            self._refuse(entry, edge, target)
        except PluginError:
            if entry.code in self._told:
                return False
            self._told.add(entry.code)
            raise
        return True

    def _refuse(self, entry: OperationEntry, edge: Address, target: str) -> None:
        if self._hardware:
            raise PluginError(f"{entry.name} is generated, and {self._world} is hardware")
        if self._trial:
            return
        trial = self._trials.get((entry.code, self._world))
        sweep = f"smsl-studio sweep FILE --world {self._world} --operation {edge.operation}"
        if trial is None:
            words = f"{entry.name} is not offered: it has not passed its sweep in {self._world}"
            raise PluginError(words, advice=f"Try it: {sweep}")
        if not trial.passed:
            words = f"{entry.name} is not offered: it failed its sweep in {self._world}"
            raise PluginError(f"{words}: {trial.sentence}", advice="Mend it, and sweep it again.")
        if (edge.state, target) not in trial.edges:
            words = f"{entry.name} is not offered for {edge}: this edge was not in its sweep"
            raise PluginError(words, advice=f"Try it: {sweep}")

    @cached_property
    def _trials(self) -> Mapping[Key, FunctionTrial]:
        return read_trials()


def left_out(blueprint: Blueprint, loaded: Loaded) -> Iterator[BindingFault]:
    """Yield why operations have no function whose generated one is not loaded."""
    for fault in loaded.faults:
        own = (f"{branch.name}/{edge.name}" for branch in blueprint for edge in branch.edges())
        missing = next((name for name in own if name in fault.operations), None)
        if missing is not None:
            yield BindingFault(missing, fault.sentence)
