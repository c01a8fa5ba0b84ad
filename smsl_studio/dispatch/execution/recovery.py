"""Relocalisation: which configurations the scene agrees with (clauses 8 and 9). Pure questions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import islice, product

from smsl_studio.blueprint.check import state_check
from smsl_studio.blueprint.configuration import disagreements
from smsl_studio.blueprint.estimate import fitting
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.stop import heed

MOST = 8
"""Candidates that are worth naming; more than one is a hold anyway."""


def stands(run: LiveRun, configuration: Mapping[str, str], vouched: bool = False) -> bool:
    """Whether every state check of a configuration is true on the scene; ``vouched``: if a person
    vouches for the doubtful facts that nobody senses."""
    scene = run.senses.vouched if vouched else None
    return all(check.truth is True for check in run.checks(configuration, scene))


def candidates(run: LiveRun) -> tuple[Mapping[str, str], ...]:
    """The configurations whose every state check is true and that agree with themselves, if a
    person vouches for the doubtful facts that nobody senses.

    Subs first, then bases. An SB whose committed state checks true keeps it.
    """
    return _agreeing(run, _true_states)


def located(run: LiveRun) -> tuple[Mapping[str, str], ...]:
    """The same, going by the scene alone: what is committed counts for nothing where it is
    sensed."""
    return _agreeing(run, _estimated)


def _agreeing(
    run: LiveRun, states_of: Callable[[LiveRun, str, Mapping[str, str]], Sequence[str]]
) -> tuple[Mapping[str, str], ...]:
    """Subs are looked at first, because a base's digits are read from them; then the bases decide
    which of their states a sub may be in. No combination is tried that the bases rule out."""
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
            # The states of an SB that fit the scene have the same facts: any of them tells.
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
    """The configuration where only one sub stands elsewhere, if that explains the whole scene.

    None where it is no sub, where no single state of it does, or where it would enter or leave
    ACTIVATING (clause 8: then it counts as pending).
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
