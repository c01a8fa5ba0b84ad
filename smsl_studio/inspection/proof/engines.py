"""Chooses the engine for a large space: a diagram, or arrays."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Meaning, branches_in
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.inspection.proof.arrays import ArraySpace
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.symbolic import SymbolicSpace

Engine = SymbolicSpace | ArraySpace

ENGINES = (SymbolicSpace.engine, ArraySpace.engine)
"""The names of all engines, as answers show them."""


MOST_PARTS = 4
"""The largest number of parts whose engines are kept. An engine may need much memory."""

_Key = tuple[frozenset[str], bool, bool]


class Engines:
    """The engines of a blueprint and of its parts. An engine is made when it is first needed.

    A route may take no step that meets one of ``hazards``. ``allowed`` has the names of the engines
    that may be used. With ``failures`` a run may also begin where one SB has failed.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        hazards: Sequence[Meaning],
        allowed: Collection[str] = ENGINES,
        failures: bool = False,
    ) -> None:
        self._blueprint, self._hazards, self._allowed = blueprint, hazards, allowed
        self._failures = failures
        self._known: dict[_Key, Engine | None] = {}
        self._parts: list[_Key] = []
        self._arrays: ArraySpace | None = None

    def engine(self, names: Collection[str], routed: bool, soon: bool = True) -> Engine | None:
        """Return the engine for some SBs, or None if every engine needs too much.

        No other SB may depend on these. With ``routed`` the engine uses only the steps that a route
        may take. ``soon`` says that arrays could answer the question, so a diagram is given up
        early. RunRefused if there is no start.
        """
        key = frozenset(names), routed, soon
        if key not in self._known:
            other = self._known.get((*key[:2], not soon))
            self._known[key] = other if isinstance(other, SymbolicSpace) else self._made(*key)
            self._forget_others(key)
        found = self._known[key]
        if isinstance(found, ArraySpace) and found is not self._arrays:
            if self._arrays is not None:
                self._arrays.forget()
            self._arrays = found
        return found

    def _forget_others(self, key: _Key) -> None:
        """Forget the engine of the oldest part, if there are more than ``MOST_PARTS``."""
        if self._known[key] is None or len(key[0]) == len(self._blueprint.branches):
            return
        self._parts.append(key)
        if len(self._parts) > MOST_PARTS:
            del self._known[self._parts.pop(0)]

    def _made(self, names: frozenset[str], routed: bool, soon: bool) -> Engine | None:
        blueprint = self._blueprint
        branches = {name: blueprint[name] for name in blueprint.branches if name in names}
        part = blueprint
        if len(branches) < len(blueprint.branches):
            part = replace(blueprint, branches=MappingProxyType(branches))
        shut = [one for one in self._hazards if names.issuperset(branches_in(one))]
        space = partial(Space, blueprint, routed, tuple(shut))
        try:
            steps = JointSteps(Hierarchy(part), shut if routed else None, self._failures)
        except TooLarge:
            return None
        if SymbolicSpace.engine in self._allowed:
            with suppress(TooLarge):
                return SymbolicSpace(space, steps, soon and not self._failures)
        arrays = ArraySpace.engine in self._allowed and not self._failures
        return ArraySpace(space, steps) if arrays else None
