"""The rule about single points of failure (R22)."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.graph.bottlenecks import bottlenecks
from smsl_studio.inspection.rules.finding import Remark, Severity
from smsl_studio.inspection.rules.words import counted, listed, some


def r22_single_points(blueprint: Blueprint) -> Iterator[Remark]:
    """R22: states and operations through which every way from INITIAL to ACTIVATING leads.

    A procedure whose steps follow each other has them on purpose, so each SB gets one note, unless
    one operation leads to the goal. An operation of high risk among them gets a warning: its
    failure ends every run.
    """
    for branch in blueprint:
        if not {branch.initial, branch.activating} <= branch.table.keys():
            continue
        found = bottlenecks(branch, branch.initial, branch.activating, failing_states(branch))
        edges = [Address(branch.name, *edge) for edge in found.edges]
        risky = [edge for edge in edges if _is_risky(branch, edge)]
        for edge in risky:
            yield Remark(
                "R22",
                Severity.WARNING,
                edge,
                "its risk is high, and every way from INITIAL to ACTIVATING takes it: if it fails, "
                "the goal is cut off",
                "add another way, or say in writing why there is none",
            )
        states = [Address(branch.name, state) for state in found.states]
        points = [*(edge for edge in edges if edge not in risky), *states]
        if points and found.length > 1:
            yield Remark(
                "R22",
                Severity.NOTE,
                points[0],
                f"every way from INITIAL to ACTIVATING leads through {_words(edges, states)}",
                "what is pruned or fails there cuts the goal off; add another way if it must not",
                others=points[1:],
            )


def _is_risky(branch: StateBranch, edge: Address) -> bool:
    return branch.operation_note(edge.state, edge.operation).risk == "high"


def _words(edges: list[Address], states: list[Address]) -> str:
    told = []
    if edges:
        names = some(f"{edge.operation} in {edge.state}" for edge in edges)
        told.append(f"{counted(len(edges), 'operation')} ({names})")
    if states:
        names = some(state.state for state in states)
        told.append(f"{counted(len(states), 'state')} ({names})")
    return listed(told)
