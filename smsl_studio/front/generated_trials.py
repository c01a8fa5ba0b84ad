"""What a sweep says about generated functions: one of which every edge passes is offered."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.generated_trials import FunctionTrial, Key, keep_trials
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.library.survey import PluginState, survey
from smsl_studio.runlog.events import EdgeSwept

LONGEST = 600
"""A reason has at most so many characters."""


def generated_operations(blueprint: Blueprint) -> tuple[str, ...]:
    """Return the ``SB/Operation`` of a blueprint for which there is an allowed generated function.
    Nothing is loaded."""
    known = {
        one.operation
        for found in survey()
        if found.manifest is not None and found.state is PluginState.ALLOWED
        for one in found.manifest.generated
    }
    if not known:
        return ()
    own = {f"{branch.name}/{edge.name}" for branch in blueprint for edge in branch.edges()}
    return tuple(sorted(known & own))


def trials_told(entry: OperationEntry, trials: Mapping[Key, FunctionTrial]) -> str:
    """Return in words in which worlds a generated function is offered, and why not elsewhere."""
    own = [one for one in trials.values() if one.function == entry.code]
    told = [f"offered in {one.world}" for one in own if one.passed]
    told += [f"failed its sweep in {one.world}: {one.sentence}" for one in own if not one.passed]
    return "; ".join(told) or "it waits for its sweep"


@dataclass
class _Tried:
    """A generated function, its edges in a blueprint, and which of them have been swept."""

    operation: str
    left: set[Address] = field(default_factory=set)
    edges: list[tuple[str, str]] = field(default_factory=list)
    sentence: str = ""


class GeneratedTrials:
    """The generated functions that a blueprint uses in a world, and the results of their edges."""

    def __init__(self, blueprint: Blueprint, world: str, loaded: Loaded | None) -> None:
        self._world = world
        self._of: dict[Address, str] = {}
        self._tried: dict[str, _Tried] = {}
        codes = {
            entry.name: entry.code
            for plugin in (loaded.plugins if loaded is not None else ())
            for entry in plugin.library.operations
            if entry.code
        }
        if loaded is None or not codes:
            return
        file = bindings_beside(blueprint.file)
        for edge, bound in bind(blueprint, loaded, world, file, trial=True).operations.items():
            if bound.generated:
                code = self._of[edge] = codes[bound.name]
                name = f"{edge.branch}/{edge.operation}"
                self._tried.setdefault(code, _Tried(name)).left.add(edge)

    def add(self, edge: Address, target: str, swept: EdgeSwept) -> None:
        """Take the result of an edge."""
        code = self._of.get(edge)
        if code is None:
            return
        one = self._tried[code]
        one.left.discard(edge)
        one.edges.append((edge.state, target))
        if not swept.passed and not one.sentence:
            words = " ".join((swept.sentence or "it did not lead to its target").split())
            one.sentence = f"{edge}: {words}"[:LONGEST]

    def kept(self) -> list[FunctionTrial]:
        """Keep what became of the functions, and return it. A function that failed is kept at once,
        one that passed if all its edges were swept. SaveError if that cannot be written."""
        trials = [
            FunctionTrial(
                function=code,
                operation=one.operation,
                world=self._world,
                passed=not one.sentence,
                edges=one.edges,
                sentence=one.sentence,
            )
            for code, one in self._tried.items()
            if one.edges and (one.sentence or not one.left)
        ]
        if trials:
            keep_trials(trials)
        return trials
