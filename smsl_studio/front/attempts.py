"""Attempts: every operation of a world is tried from a state that is arranged anew."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.errors import UsageError, WorldError
from smsl_studio.front.hosts import make_host
from smsl_studio.front.request import RunRequest
from smsl_studio.front.single_edge import carried_out
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.runlog.events import OperationEnded
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.stop import heed

Json = Any
Values = tuple[str, ...]
MOST_OPERATIONS = 2_000
"""The largest number of operations that are tried in one state."""
_HERE = "State_here"


def bound_names(
    loaded: Loaded, world: str, branch: StateBranch, *, recovery: bool = False
) -> tuple[str, ...]:
    """Return the names of all operations that a world binds, with arguments from facts and their
    values. Those registered for recovery are left out, if not asked for. UsageError if there are
    too many."""
    found: dict[str, None] = {}
    skipped: set[str] = set()
    for plugin in loaded.serving(world):
        for entry in plugin.library.operations:
            for name in _names(entry, branch):
                heed()
                (skipped.add(name) if entry.recovery and not recovery else found.setdefault(name))
                if len(found) > MOST_OPERATIONS:
                    raise UsageError(
                        f"the world {world} has more than {MOST_OPERATIONS:,} operations with all "
                        "arguments",
                        advice="Take a blueprint with fewer facts or values.",
                    )
    return tuple(name for name in found if name not in skipped)


def recovery_names(loaded: Loaded, world: str, branch: StateBranch) -> frozenset[str]:
    """Return the names of the operations that a world binds for recovery."""
    return frozenset(
        name
        for plugin in loaded.serving(world)
        for entry in plugin.library.operations
        if entry.recovery
        for name in _names(entry, branch)
    )


def _names(entry: OperationEntry, branch: StateBranch) -> Iterator[str]:
    """Give the names that a pattern has with facts and values as its arguments."""
    if entry.pattern is None:
        return
    digits = [str(number + 1) for number in range(branch.num_facts)]
    notes = (branch.fact_note(digit) for digit in range(branch.num_facts))
    facts = [note.name for note in notes if note is not None and note.name]
    values = sorted({value for alphabet in branch.alphabet for value in alphabet})
    choices: list[Sequence[str]] = []
    for parameter in entry.pattern.parameters:
        kind = entry.signature.types.get(parameter, str)
        if kind is bool:
            choices.append(("true", "false"))
        elif kind in (int, float):
            numbers = [one for one in values if one.isascii() and one.isdecimal()]
            choices.append(tuple(dict.fromkeys((*digits, *numbers))))
        else:
            choices.append(tuple(dict.fromkeys((*values, *facts))))
    for chosen in itertools.islice(itertools.product(*choices), MOST_OPERATIONS + 1):
        given = dict(zip(entry.pattern.parameters, chosen, strict=True))
        whole = entry.pattern.fill(given)
        operation = whole.removeprefix(f"{branch.name}/") if "/" in entry.pattern.text else whole
        if "/" not in operation and entry.texts(branch.name, operation) == given:
            yield operation


@dataclass(frozen=True, slots=True)
class Attempt:
    """How an operation ended. ``values`` are the facts afterwards, None if one is not known.
    ``returned`` says that its function returned, from a source that was true."""

    values: Values | None
    returned: bool


@dataclass(slots=True)
class TriedState:
    """What was tried in one state: where operations lead.

    ``rates`` has for each operation that works sometimes how often it worked, and ``lost`` the
    facts after attempts that failed, where a fact has a value that no state of the start has.
    ``idle`` are operations that returned and changed no fact.
    """

    row: dict[str, Values] = field(default_factory=dict)
    rates: dict[str, int] = field(default_factory=dict)
    lost: dict[Values, None] = field(default_factory=dict)
    idle: list[str] = field(default_factory=list)


class Attempts:
    """Tries operations, each from a state that is arranged anew.

    An operation leads somewhere if it does in all ``repeats``. With ``rates`` once is enough: it
    leads where it led most often.
    """

    def __init__(
        self,
        request: RunRequest,
        loaded: Loaded,
        names: Sequence[str],
        repeats: int,
        rates: bool = False,
    ) -> None:
        self._request, self._loaded, self._names = request, loaded, names
        self._repeats, self._rates = repeats, rates
        (self._branch,) = request.blueprint
        self._alphabet = [frozenset(own) for own in self._branch.alphabet]

    @property
    def names(self) -> Sequence[str]:
        """The operations that are tried."""
        return self._names

    def leave_out_unfit(self, values: Values) -> None:
        """Leave out the operations with arguments that the world does not have: a world refuses a
        blueprint that moves a disk to a peg named "disk 1". ``values`` are those of the start.
        WorldError if the world refuses the start, or all operations."""
        names = tuple(self._names)
        self._names = self._fit(values, names)
        if not self._names:
            self._open(values, names)

    def _fit(self, values: Values, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return those of some operations that the world does not refuse."""
        heed()
        try:
            self._open(values, names)
        except WorldError:
            if len(names) == 1:
                return ()
            half = len(names) // 2
            return self._fit(values, names[:half]) + self._fit(values, names[half:])
        return names

    def _open(self, values: Values, names: Sequence[str]) -> None:
        """Open the world once for a state with these operations. WorldError if it refuses them."""
        host = self._host(self._here(values, names), 0)
        try:
            host.open({self._branch.name: _HERE})
        finally:
            host.close()

    def may_give(self, tried: TriedState) -> bool:
        """Return whether what was kept has only operations and values that there are."""
        names = set(self._names)
        return (
            {*tried.row, *tried.rates, *tried.idle} <= names
            and all(map(self._is_known, tried.row.values()))
            and all(0 < worked < self._repeats for worked in tried.rates.values())
            and all(len(values) == len(self._alphabet) for values in tried.lost)
            and (self._rates or not (tried.rates or tried.lost))
        )

    def state(self, values: Values) -> TriedState:
        """Try all operations from some values."""
        hierarchy = Hierarchy(self._here(values, self._names))
        ends: dict[str, list[Attempt]] = {name: [] for name in self._names}
        for seed in range(self._repeats):
            left = [name for name, own in ends.items() if self._is_open(own, values)]
            self._try_all(hierarchy, left, seed, ends)
        found = TriedState()
        for name, own in ends.items():
            self._judge(found, name, values, own)
        return found

    def _is_open(self, ends: Sequence[Attempt], source: Values) -> bool:
        """Return whether a further attempt may change what is known of an operation."""
        alike = all(end.returned and self._is_known(end.values or ()) for end in ends)
        alike = alike and all(end == ends[0] for end in ends)
        return self._rates or alike

    def _try_all(
        self,
        hierarchy: Hierarchy,
        names: Sequence[str],
        seed: int,
        ends: Mapping[str, list[Attempt]],
    ) -> None:
        """Try some operations in a world of one seed, and add how they ended."""
        if not names:
            return
        host = self._host(hierarchy.blueprint, seed)
        try:
            for name in names:
                heed()
                end, gone = self._end(hierarchy, host, name, seed)
                ends[name].append(end)
                if gone:
                    host.close()
                    host = self._host(hierarchy.blueprint, seed)
        finally:
            host.close()

    def _judge(self, found: TriedState, name: str, values: Values, ends: Sequence[Attempt]) -> None:
        """Add what the attempts with one operation have shown."""
        if all(end == Attempt(values, True) for end in ends):
            found.idle.append(name)
        worked = Counter(end.values for end in ends if self._leads(end, values))
        if not worked:
            return
        (target, count), *_ = worked.most_common(1)
        assert target is not None
        if count == self._repeats:
            found.row[name] = target
        elif self._rates:
            found.row[name], found.rates[name] = target, count
            others = (end.values for end in ends if end.values is not None)
            found.lost |= dict.fromkeys(one for one in others if not self._is_known(one))

    def _leads(self, end: Attempt, source: Values) -> bool:
        """Return whether an attempt has led to another state."""
        return (
            end.returned
            and end.values is not None
            and end.values != source
            and self._is_known(end.values)
        )

    def _is_known(self, values: Values) -> bool:
        """Return whether each fact has a value that the start has."""
        return len(values) == len(self._alphabet) and all(
            value in own for value, own in zip(values, self._alphabet, strict=True)
        )

    def _host(self, blueprint: Blueprint, seed: int) -> Host:
        return make_host(replace(self._request, blueprint=blueprint, seed=seed), self._loaded)

    def _end(self, hierarchy: Hierarchy, host: Host, name: str, seed: int) -> tuple[Attempt, bool]:
        """Return how an operation ended, and whether the host was lost."""
        branch = self._branch.name
        edge = Address(branch, _HERE, name)
        start = {branch: _HERE}
        terms = RunTerms(start, seed=seed, automatic=False, guarded=False)
        dispatcher = Dispatcher(hierarchy.blueprint, host, terms)
        events, source = carried_out(hierarchy, dispatcher, host, edge, start)
        at_end = dispatcher.standing
        lost = at_end.reason == "failed"
        outcomes = [one.outcome for one in events if isinstance(one, OperationEnded)]
        if lost or source != "true":
            return Attempt(None, False), lost
        readings = [at_end.scene.get(branch, digit) for digit in range(len(self._alphabet))]
        values = [one.value for one in readings if one is not None and one.value is not None]
        known = tuple(values) if len(values) == len(self._alphabet) else None
        return Attempt(known, outcomes == ["returned"]), lost

    def _here(self, values: Values, names: Sequence[str]) -> Blueprint:
        """Return a blueprint of one state, from which every operation leads back to it."""
        branch = self._branch
        fields: dict[str, Json] = {
            key: value
            for key, value in branch.fields.items()
            if key not in ("_states", "_layout", "_operations")
        }
        fields["_states"] = {_HERE: {"facts": list(values)}}
        header = {"INITIAL": _HERE, "ACTIVATING": _HERE, "NUM_FACTS": len(values)}
        row = dict.fromkeys(names, _HERE)
        text = write_json({branch.name: {"HEADER": header, **fields, _HERE: row}})
        return read_blueprint(parse_json(text, "here.json"))
