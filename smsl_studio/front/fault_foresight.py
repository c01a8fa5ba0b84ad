"""How a run with a fault in an operation will end, from the blueprint and the effect of the fault.

No world is needed. The effect (see ``library.fault_effect``) says which facts the operation leaves,
and which operations stay impossible. The planner then says whether a route leads from there to the
goal, as ``check --recoverability`` does. Of a fault without an effect it is foreseen that the
operation fails and nothing else changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import StudioError
from smsl_studio.front.starts import start_for_edge
from smsl_studio.library.entries import FaultEntry
from smsl_studio.library.fault_effect import FAILS, FaultEffect

Arguments = Mapping[str, Any]
REACHED, HELD = "reached", "held"
ANOTHER_WAY = "if it fails, another way leads to the goal"
NO_OTHER_WAY = "if it fails, no other way leads to the goal"


@dataclass(frozen=True, slots=True)
class FaultEnd:
    """How a run ends: ``reached`` or ``held``, and why, in words that follow "because".

    ``facts`` are those of the operation's SB afterwards, None for an unknown one. ``disturbed`` is
    false if the fault changes nothing.
    """

    end: str
    why: str
    facts: tuple[str | None, ...]
    disturbed: bool = True


class FaultForesight:
    """Foresees the runs of one blueprint. ``arguments`` are those of each operation's function.

    ``adopts`` says that a run goes on where its facts are those of another state; else it holds.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        faults: Mapping[str, FaultEntry],
        arguments: Mapping[Address, Arguments],
        goals: tuple[str, ...] = (),
        adopts: bool = False,
    ) -> None:
        self._blueprint, self._faults, self._arguments = blueprint, faults, arguments
        self._hierarchy = Hierarchy(blueprint)
        self._adopts = adopts
        named = tuple(Address(*Address.split(goal)) for goal in goals)
        roots = (Address(name, blueprint[name].activating) for name in self._hierarchy.roots)
        self._goals = list(named or roots)

    def look(self, fault: str, edge: Address) -> FaultEnd | None:
        """Return how runs with a fault in an operation end. None if that cannot be foreseen."""
        branch = self._blueprint.branches.get(edge.branch)
        if branch is None or edge.operation not in branch.table.get(edge.state, {}):
            return None
        effect = self._effect(fault, edge, branch.facts(edge.state))
        if effect is None:
            return None
        try:
            return self._foreseen(branch, edge, effect)
        except StudioError:
            return None

    def _effect(self, fault: str, edge: Address, facts: tuple[str, ...]) -> FaultEffect | None:
        """Return the effect of a fault. None if the plugin has none that fits: its code is not
        trusted."""
        entry = self._faults.get(fault)
        if entry is None or entry.effect is None:
            return FAILS
        try:
            told = entry.effect(facts, dict(self._arguments.get(edge, {})))
            assert isinstance(told, FaultEffect)
            places, values = set(told.facts), tuple(told.facts.values())
            assert places <= set(range(len(facts)))
            assert all(value is None or type(value) is str for value in values)
            assert all(isinstance(one, Mapping) for one in told.shut)
            assert type(told.why) is str
        except KeyboardInterrupt:
            raise
        except BaseException:  # SystemExit, and what compiled libraries raise
            return None
        return told

    def _foreseen(self, branch: StateBranch, edge: Address, effect: FaultEffect) -> FaultEnd | None:
        source, target = edge.state, branch.table[edge.state][edge.operation]
        before = branch.facts(source)
        after = tuple(effect.facts.get(digit, value) for digit, value in enumerate(before))
        if after == branch.facts(target) and not effect.shut:
            return FaultEnd(REACHED, "it changes nothing", after, disturbed=False)
        states = {source, target} if after in (before, branch.facts(target)) else set(branch.table)
        fitting = [one for one in branch.table if one in states and branch.facts(one) == after]
        if len(fitting) != 1:
            return FaultEnd(HELD, effect.why or "no state has the facts afterwards", after)
        (state,) = fitting
        if state not in (source, target) and not self._adopts:
            why = f"the facts afterwards are those of {state}, and a run holds then"
            return FaultEnd(HELD, why, after)
        start = start_for_edge(self._hierarchy, edge)
        if start is None:
            return None
        shut = {
            address: "impossible"
            for address, own in self._arguments.items()
            if any(all(own.get(key) == one[key] for key in one) for one in effect.shut)
        }
        planner = Planner(self._hierarchy, Terms(shut={**shut, edge: "risky"}))
        legs = planner.legs({**start, edge.branch: state}, self._goals)
        if legs is None:
            return FaultEnd(HELD, effect.why or NO_OTHER_WAY, after)
        return FaultEnd(REACHED, ANOTHER_WAY, after)
