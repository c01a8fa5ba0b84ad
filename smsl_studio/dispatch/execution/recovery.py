"""Relocalisation: the configurations that fit the scene (clauses 8 and 9). Nothing is changed
here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import islice, product

from smsl_studio.blueprint.check import state_check
from smsl_studio.blueprint.configuration import disagreements
from smsl_studio.blueprint.estimate import fitting
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.stop import heed

MOST = 8
"""The largest number of candidates that are named. With more than one the run holds in any case."""


def stands(run: LiveRun, configuration: Mapping[str, str], vouched: bool = False) -> bool:
    """Return whether every state check of a configuration is true on the scene.

    ``vouched`` leaves out the doubtful facts that nobody senses, as if a person vouched for them.
    """
    scene = run.senses.vouched if vouched else None
    return all(check.truth is True for check in run.checks(configuration, scene))


def candidates(run: LiveRun) -> tuple[Mapping[str, str], ...]:
    """Return the consistent configurations whose state checks are all true, at most ``MOST``.

    Doubtful facts that nobody senses are left out. An SB keeps its committed state if its check is
    true.
    """
    return _agreeing(run, _true_states)


def located(run: LiveRun) -> tuple[Mapping[str, str], ...]:
    """Return the same from the scene alone. A committed state counts only for facts that are not
    sensed.
    """
    return _agreeing(run, _estimated)


def _agreeing(
    run: LiveRun, states_of: Callable[[LiveRun, str, Mapping[str, str]], Sequence[str]]
) -> tuple[Mapping[str, str], ...]:
    """Return the consistent configurations from the states of each SB that fit.

    Sub-SBs come first, because the digits of a base depend on them. Then the bases decide which of
    its states a sub-SB may be in, so only these combinations are tried.
    """
    known, blueprint = run.hierarchy, run.blueprint
    believed = dict(run.configuration)
    found: dict[str, Sequence[str]] = {}
    for name in reversed(known.order):
        heed()
        found[name] = states_of(run, name, believed)
        if not found[name]:
            return ()
        believed[name] = found[name][0]
    for name in known.order:
        for base, digit in known.bases[name]:
            # All fitting states of an SB have the same facts, so the first one decides.
            on = blueprint[base].is_on(found[base][0], digit)
            found[name] = [s for s in found[name] if (s == blueprint[name].activating) == on]
        if not found[name]:
            return ()
    names = list(run.configuration)
    every = (
        dict(zip(names, states, strict=True)) for states in product(*(found[n] for n in names))
    )
    return tuple(one for one in islice(every, MOST) if stands(run, one, vouched=True))


def sub_relocalised(run: LiveRun, branch: str) -> Mapping[str, str] | None:
    """Return the configuration in which only this sub-SB has moved, if it explains the whole scene.

    None if the SB is no sub-SB, if not exactly one of its states fits, or if it would enter or
    leave ACTIVATING (clause 8: then the failure counts as pending).
    """
    if not run.hierarchy.bases[branch]:
        return None
    states = _true_states(run, branch, run.configuration)
    if len(states) != 1:
        return None
    moved = {**run.configuration, branch: states[0]}
    if disagreements(run.hierarchy, moved) or not stands(run, moved):
        return None
    return moved


def _true_states(run: LiveRun, name: str, believed: Mapping[str, str]) -> Sequence[str]:
    scene, committed = run.senses.vouched, run.configuration[name]
    if state_check(run.blueprint, name, committed, scene, believed).truth is True:
        return [committed]
    return _estimated(run, name, believed)


def _estimated(run: LiveRun, name: str, believed: Mapping[str, str]) -> Sequence[str]:
    return fitting(run.blueprint, name, run.senses.vouched, believed)
