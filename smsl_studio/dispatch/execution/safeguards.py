"""Safeguards: the facts that a run needs at every tick, also in the middle of an operation.

These are all critical facts of the blueprint, and the facts that the running edges require. Each
must be known and have the believed value, unless the step itself changes it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from smsl_studio.blueprint.check import IN_TRANSIT, FactKey, Term, state_check
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointAction, JointStep
from smsl_studio.dispatch.execution.effects import changed_by
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.words import critical_words, required_words

NOTHING: frozenset[FactKey] = frozenset()


def lost_critical(run: LiveRun, changing: Collection[FactKey] = NOTHING) -> tuple[str, ...]:
    """Return the critical facts that are false or unknown now, as sentences.

    ``changing`` are the facts that a step changes at this moment.
    """
    if not run.critical:
        return ()
    return tuple(critical_words(run.blueprint, term) for term in lost_terms(run, changing))


def lost_terms(run: LiveRun, changing: Collection[FactKey] = NOTHING) -> Iterator[Term]:
    """Yield the same facts as terms of their state checks."""
    believed, scene = run.believed, run.senses.scene
    left_out = run.transit.union(changing)
    for name, digits in run.critical.items():
        state = believed[name]
        check = state_check(run.blueprint, name, state, scene, believed, transit=left_out)
        if check.truth is True:
            continue
        for digit in digits:
            term = check.terms[digit]
            if term.truth is not True and term.reason != IN_TRANSIT:
                yield term


class Safeguards:
    """The facts that one step needs while it is carried out.

    Call ``begin`` before the function of an action starts, and ``end`` after its check was true.
    """

    def __init__(self, run: LiveRun, step: JointStep) -> None:
        self._run = run
        self._idle = not run.critical and not any(edge.requires for edge in step.edges)
        self._required: list[Edge] = []
        self._changing = NOTHING
        self._changed: set[FactKey] = set()

    def begin(self, action: JointAction) -> tuple[str, ...]:
        """Return why the edges of an action may not begin: required or critical facts that do not
        hold.

        From now on the facts that the action changes are left out, and those that its edges require
        must stay.
        """
        if self._idle:
            return ()
        self._required.extend(edge for edge in action.begins if edge.requires)
        lost = self.lost()
        self._changing = frozenset(changed_by(self._run, action)) | action.transit
        self._changed |= self._changing
        return lost

    def end(self, action: JointAction) -> None:
        """Note that an action has ended. The facts that it changed must have the believed values
        from now on.
        """
        self._changing = NOTHING
        self._required = [edge for edge in self._required if edge not in action.commits]

    def lost(self, asked: Collection[FactKey] = NOTHING) -> tuple[str, ...]:
        """Return the needed facts that are false or unknown now, as sentences. ``asked`` are the
        facts that people are asked for; they are left out.
        """
        if self._idle:
            return ()
        changing = self._changing.union(asked)
        required = (word for edge in self._required for word in self._unmet(edge, changing))
        return tuple(dict.fromkeys((*required, *lost_critical(self._run, changing))))

    def _unmet(self, edge: Edge, changing: Collection[FactKey]) -> Iterator[str]:
        """Yield the facts that an edge requires, that the step has not changed, and that do not
        hold.
        """
        run = self._run
        believed, left_out = run.believed, run.transit.union(changing)
        for name, digit, value in edge.requires:
            if (name, digit) in self._changed:
                continue
            check = state_check(
                run.blueprint, name, believed[name], run.senses.scene, believed, transit=left_out
            )
            term = check.terms[digit]
            if term.reading != value and term.reason != IN_TRANSIT:
                wanted = Term(term.fact, value, term.reading, _same(term, value), term.reason)
                yield required_words(run.blueprint, edge, wanted)


def _same(term: Term, value: str) -> bool | None:
    return None if term.reading is None else term.reading == value
