"""A blueprint from physics: every operation is tried in every state that is found."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.errors import PlanningError, UsageError
from smsl_studio.front.explored_part import ExploredPart, exploration_head
from smsl_studio.front.generated import PART, Generated
from smsl_studio.front.hosts import known_world, make_host, with_robot
from smsl_studio.front.request import RunRequest
from smsl_studio.front.single_edge import carried_out
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.operation_entry import OperationEntry
from smsl_studio.runlog.events import OperationEnded
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.stop import heed

Json = Any
Values = tuple[str, ...]
LIMIT = 10_000
"""The largest number of states that are explored, if nothing else is said."""
MOST_OPERATIONS = 2_000
"""The largest number of operations that are tried in one state."""
_HERE = "State_here"


@dataclass(frozen=True)
class Explored:
    """What physics permits. ``bound`` says that there are more states than were to be explored."""

    generated: Generated
    bound: bool


@dataclass
class ExploredRows:
    """The states that were found, in order, and where the operations of those that were tried lead.
    ``bound`` says that there are further states."""

    rows: dict[Values, dict[str, Values]] = field(default_factory=dict)
    bound: bool = False

    def add(self, values: Values, row: Mapping[str, Values], limit: int) -> list[Values]:
        """Add what was tried in a state. Return the states that are new."""
        new: list[Values] = []
        own = self.rows.setdefault(values, {})
        for name, target in row.items():
            if target not in self.rows:
                if len(self.rows) >= limit:
                    self.bound = True
                    continue
                self.rows[target] = {}
                new.append(target)
            own[name] = target
        return new


def generate_explore(
    start: Blueprint,
    world: str,
    *,
    repeats: int = 1,
    limit: int = LIMIT,
    plugin_paths: Sequence[Path] = (),
    going: Callable[[int, int], None] | None = None,
    robot: str = "",
    part: Path | None = None,
    tried: Callable[[Values, Mapping[str, Values]], None] | None = None,
) -> Explored:
    """Return the blueprint of a world: all states that its operations reach, from a start on.

    ``start`` gives INITIAL, the facts with their values, and what binds them. An operation is an
    edge if its function returned in all ``repeats`` (with the seeds 0, 1, ...), the source was true
    before, and the same facts were read afterwards: known values that ``start`` has, and not those
    of the source. ``going`` is told the numbers of states that are done and found, ``tried`` the
    values of each state that is done and where its operations lead. ``part`` is a file that keeps
    what was tried: an exploration that was broken off goes on from there.

    UsageError for a world without operations of its own. PlanningError for several SBs. WorldError
    for a world that does not exist or does not suit.

    >>> from smsl_studio.world.engines import TABLE
    >>> generate_explore(read("hanoi.json"), TABLE)
    Traceback (most recent call last):
    ...
    smsl_studio.errors.UsageError: the world table has no operations of its own
    """
    if len(start) != 1:
        raise PlanningError(
            f"physics is explored for one State Branch, and here are {len(start)}",
            advice="Extract or flatten one of them first.",
        )
    (branch,) = start
    loaded = known_world(world, plugin_paths)
    if loaded is None:
        raise UsageError(f"the world {world} has no operations of its own")
    names = bound_names(loaded, world, branch)
    paths = tuple(plugin_paths)
    request = RunRequest(start, world, host="local", plugin_paths=paths, robot=robot)
    request = with_robot(request, loaded)
    attempts = _Attempts(request, loaded, names, repeats)
    head = exploration_head(request, names, repeats) if part is not None else ""
    kept = ExploredPart(part, head)
    try:
        found = _explored(attempts, branch, limit, kept, going, tried)
    finally:
        kept.close()
    return Explored(explored_blueprint(found, start, world), found.bound)


def start_of_values(text: str, world: str, plugin_paths: Sequence[Path] = ()) -> Blueprint:
    """Return a blueprint for ``generate_explore`` that starts with some values: ``a,a,a`` or
    ``aaa``. Each fact may have the values that the world's plugin declares.

    UsageError if the world declares none, or not these.
    """
    loaded = known_world(world, plugin_paths)
    declared = () if loaded is None else loaded.world(world)[1].values
    if not declared:
        raise UsageError(
            f"the world {world} does not declare the values of its facts",
            advice="Name a blueprint as the start.",
        )
    width = len(declared[0])
    plain = text.removeprefix("State_")
    values = plain.split(",") if "," in plain else _cut(plain, width)
    if not plain or any(value not in declared for value in values):
        raise UsageError(
            f"{text!r} is no start of the world {world}",
            advice=f"Name a blueprint, or a value for each fact: {', '.join(declared)}.",
        )
    first = "State_" + "".join(values)
    names = [first, *("State_" + one * len(values) for one in declared)]
    header = {"INITIAL": first, "ACTIVATING": first, "NUM_FACTS": len(values)}
    return _built({"SB1": {"HEADER": header, **{name: {} for name in names}}}, "start.json")


def _cut(text: str, width: int) -> list[str]:
    return [text[at : at + width] for at in range(0, len(text), width)]


def bound_names(loaded: Loaded, world: str, branch: StateBranch) -> tuple[str, ...]:
    """Return the names of all operations that a world binds, with arguments from facts and their
    values. UsageError if there are too many."""
    found: dict[str, None] = {}
    skipped: set[str] = set()
    for plugin in loaded.serving(world):
        for entry in plugin.library.operations:
            for name in _names(entry, branch):
                heed()
                (skipped.add(name) if entry.recovery else found.setdefault(name))
                if len(found) > MOST_OPERATIONS:
                    raise UsageError(
                        f"the world {world} has more than {MOST_OPERATIONS:,} operations with all "
                        "arguments",
                        advice="Take a blueprint with fewer facts or values.",
                    )
    return tuple(name for name in found if name not in skipped)


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


class _Attempts:
    """Tries operations, each from a state that is arranged anew."""

    def __init__(
        self, request: RunRequest, loaded: Loaded, names: Sequence[str], repeats: int
    ) -> None:
        self._request, self._loaded, self._names = request, loaded, names
        self._repeats = repeats
        (self._branch,) = request.blueprint
        self._alphabet = [frozenset(own) for own in self._branch.alphabet]

    def may_give(self, row: Mapping[str, Values]) -> bool:
        """Return whether a row that was kept has only operations and values that there are."""
        return set(row) <= set(self._names) and all(
            len(target) == len(self._alphabet)
            and all(value in own for value, own in zip(target, self._alphabet, strict=True))
            for target in row.values()
        )

    def row(self, values: Values) -> dict[str, Values]:
        """Return where each operation leads from some values."""
        blueprint = self._here(values)
        hierarchy = Hierarchy(blueprint)
        found: dict[str, Values] = {}
        host = self._host(blueprint)
        try:
            for name in self._names:
                ends: set[Values | None] = set()
                for seed in range(self._repeats):
                    heed()
                    end, lost = self._end(hierarchy, host, name, seed)
                    ends.add(end)
                    if lost:
                        host.close()
                        host = self._host(blueprint)
                    if end is None or len(ends) > 1:
                        break
                if len(ends) == 1:
                    (end,) = ends
                    if end is not None and end != values:
                        found[name] = end
        finally:
            host.close()
        return found

    def _host(self, blueprint: Blueprint) -> Host:
        return make_host(replace(self._request, blueprint=blueprint), self._loaded)

    def _end(
        self, hierarchy: Hierarchy, host: Host, name: str, seed: int
    ) -> tuple[Values | None, bool]:
        """Return the facts after an operation, None if it made no edge, and whether the host was
        lost."""
        branch = self._branch.name
        start = {branch: _HERE}
        edge = Address(branch, _HERE, name)
        terms = RunTerms(start, seed=seed, automatic=False, guarded=False)
        dispatcher = Dispatcher(hierarchy.blueprint, host, terms)
        events, source = carried_out(hierarchy, dispatcher, host, edge, start)
        at_end = dispatcher.standing
        lost = at_end.reason == "failed"
        outcomes = [one.outcome for one in events if isinstance(one, OperationEnded)]
        if lost or source != "true" or outcomes != ["returned"]:
            return None, lost
        values: list[str] = []
        for digit, alphabet in enumerate(self._alphabet):
            reading = at_end.scene.get(branch, digit)
            if reading is None or reading.value not in alphabet:
                return None, lost
            values.append(reading.value)
        return tuple(values), lost

    def _here(self, values: Values) -> Blueprint:
        """Return a blueprint of one state, from which every operation leads back to it."""
        branch = self._branch
        fields: dict[str, Json] = {
            key: value
            for key, value in branch.fields.items()
            if key not in ("_states", "_layout", "_operations")
        }
        fields["_states"] = {_HERE: {"facts": list(values)}}
        header = {"INITIAL": _HERE, "ACTIVATING": _HERE, "NUM_FACTS": len(values)}
        row = dict.fromkeys(self._names, _HERE)
        return _built({branch.name: {"HEADER": header, **fields, _HERE: row}}, "here.json")


def _explored(
    attempts: _Attempts,
    branch: StateBranch,
    limit: int,
    kept: ExploredPart,
    going: Callable[[int, int], None] | None,
    tried: Callable[[Values, Mapping[str, Values]], None] | None,
) -> ExploredRows:
    """Try all operations in all states that are found, breadth first."""
    start = branch.facts(branch.initial)
    found = ExploredRows({start: {}})
    queue = deque([start])
    done = 0
    while queue:
        values = queue.popleft()
        row = kept.known.get(values)
        if row is None or not attempts.may_give(row):
            row = attempts.row(values)
            kept.keep(values, row)
        queue.extend(found.add(values, row, limit))
        done += 1
        if tried is not None:
            tried(values, row)
        if going is not None:
            going(done, len(found.rows))
    return found


def explored_blueprint(found: ExploredRows, start: Blueprint, world: str) -> Generated:
    """Return the blueprint of what was found so far, from the INITIAL state of ``start`` on."""
    (branch,) = start
    known = {branch.facts(name): name for name in reversed(branch.table)}
    names = {values: known.get(values, "State_" + "".join(values)) for values in found.rows}
    goal = branch.facts(branch.activating)
    reached = goal in found.rows
    header: dict[str, Json] = {"INITIAL": names[branch.facts(branch.initial)]}
    if reached:
        header["ACTIVATING"] = names[goal]
    header["NUM_FACTS"] = branch.num_facts
    notes = branch.fields.get("_states")
    told = isinstance(notes, Mapping) and any("facts" in one for one in notes.values())
    fields: dict[str, Json] = {}
    if "_facts" in branch.fields:
        fields["_facts"] = branch.fields["_facts"]
    if told:
        fields["_states"] = {names[one]: {"facts": list(one)} for one in found.rows}
    table = {
        names[values]: {name: names[target] for name, target in row.items()}
        for values, row in found.rows.items()
    }
    raw = write_json({one.name: dict(one.table) for one in start}).encode()
    origin: dict[str, Json] = {"how": "explore", "from": world, "digest": sha256_hex(raw)}
    if found.bound:
        origin |= PART
    values = {branch.name: {"HEADER": header, **fields, **table}, "_origin": origin}
    blueprint = _built(values, "explored.json")
    operations = sum(map(len, table.values()))
    return Generated(blueprint, len(table), operations, reached, not found.bound)


def _built(values: dict[str, Json], name: str) -> Blueprint:
    return read_blueprint(parse_json(write_json(values), name))


@dataclass(frozen=True)
class PhysicsDifference:
    """Edges of another blueprint that were not found, and edges that it does not have."""

    edges: int
    missing: tuple[str, ...]
    false: tuple[str, ...]


def against(explored: Blueprint, other: Blueprint) -> PhysicsDifference:
    """Compare the edges of two blueprints of one State Branch, by facts and operation names."""
    if len(other) != 1:
        raise PlanningError(f"edges are compared with one State Branch, not {len(other)}")
    ours, theirs = _edges(explored), _edges(other)
    return PhysicsDifference(
        len(ours),
        tuple(address for key, address in theirs.items() if key not in ours),
        tuple(address for key, address in ours.items() if key not in theirs),
    )


def _edges(blueprint: Blueprint) -> dict[tuple[Values, str, Values], str]:
    (branch,) = blueprint
    return {
        (branch.facts(state), operation, branch.facts(target)): str(
            Address(branch.name, state, operation)
        )
        for state, row in branch.table.items()
        for operation, target in row.items()
        if target in branch.table
    }
