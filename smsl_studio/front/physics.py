"""A blueprint from physics: every operation is tried in every state that is found."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import PlanningError, UsageError
from smsl_studio.front.attempts import Attempts, TriedState, Values, bound_names
from smsl_studio.front.campaign_rates import risk_word
from smsl_studio.front.explored_part import ExploredPart, exploration_head
from smsl_studio.front.generated import PART, Generated
from smsl_studio.front.hosts import known_world, with_robot
from smsl_studio.front.request import RunRequest
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
LIMIT = 10_000
"""The largest number of states that are explored, if nothing else is said."""


@dataclass(frozen=True)
class Explored:
    """What physics permits. ``bound`` says that there are more states than were to be explored."""

    generated: Generated
    bound: bool
    rates: Mapping[str, int] = field(default_factory=dict)
    """How often each operation worked, by its address, of those that work sometimes."""
    idle: Collection[tuple[Values, str]] = ()
    """States and operations that returned there and changed no fact."""


@dataclass
class ExploredRows:
    """The states that were found, in order, and where the operations of those that were tried lead.
    ``bound`` says that there are further states."""

    rows: dict[Values, dict[str, Values]] = field(default_factory=dict)
    bound: bool = False
    rates: dict[tuple[Values, str], int] = field(default_factory=dict)
    """How often operations worked that work sometimes."""
    lost: dict[Values, None] = field(default_factory=dict)
    """Facts after attempts that failed."""
    idle: set[tuple[Values, str]] = field(default_factory=set)
    """Operations that returned and changed no fact."""

    def add(self, values: Values, tried: TriedState, limit: int) -> list[Values]:
        """Add what was tried in a state. Return the states that are new."""
        new: list[Values] = []
        own = self.rows.setdefault(values, {})
        self.rates |= {(values, name): worked for name, worked in tried.rates.items()}
        self.lost |= tried.lost
        self.idle |= {(values, name) for name in tried.idle}
        for name, target in tried.row.items():
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
    rates: bool = False,
    tried: Callable[[Values, TriedState], None] | None = None,
) -> Explored:
    """Return the blueprint of a world: all states that its operations reach, from a start on.

    ``start`` gives INITIAL, the facts with their values, and what binds them. An operation is an
    edge if its function returned in all ``repeats`` (with the seeds 0, 1, ...), the source was true
    before, and the same facts were read afterwards: known values that ``start`` has, and not those
    of the source. ``going`` is told the numbers of states that are done and found, ``tried`` the
    values of each state that is done and where its operations lead. ``part`` is a file that keeps
    what was tried: an exploration that was broken off goes on from there.

    With ``rates`` an operation that works in some of the ``repeats`` is an edge, too: it gets the
    risk and the cost that follow from its rate, and the facts after a failure become a state whose
    values are failure values.

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
    attempts = Attempts(request, loaded, names, repeats, rates)
    attempts.leave_out_unfit(branch.facts(branch.initial))
    names = tuple(attempts.names)
    head = exploration_head(request, names, repeats, rates) if part is not None else ""
    kept = ExploredPart(part, head)
    try:
        found = _explored(attempts, branch, limit, kept, going, tried)
    finally:
        kept.close()
    made = explored_blueprint(found, start, world, repeats)
    (ours,) = made.blueprint
    named = {ours.facts(state): state for state in ours.table}
    told = {str(Address(ours.name, named[values], operation)): worked
            for (values, operation), worked in found.rates.items()}  # fmt: skip
    return Explored(made, found.bound, told, found.idle)


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


def _explored(
    attempts: Attempts,
    branch: StateBranch,
    limit: int,
    kept: ExploredPart,
    going: Callable[[int, int], None] | None,
    tried: Callable[[Values, TriedState], None] | None,
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
            row = attempts.state(values)
            kept.keep(values, row)
        queue.extend(found.add(values, row, limit))
        done += 1
        if tried is not None:
            tried(values, row)
        if going is not None:
            going(done, len(found.rows))
    return found


def explored_blueprint(
    found: ExploredRows, start: Blueprint, world: str, repeats: int = 1
) -> Generated:
    """Return the blueprint of what was found so far, from the INITIAL state of ``start`` on."""
    (branch,) = start
    known = {branch.facts(name): name for name in reversed(branch.table)}
    lost = [values for values in found.lost if values not in found.rows]
    states = [*found.rows, *lost]
    names = {values: known.get(values, "State_" + "".join(values)) for values in states}
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
    if lost:
        fields["_facts"] = _with_failures(branch, lost)
    if told:
        fields["_states"] = {names[one]: {"facts": list(one)} for one in states}
    if found.rates:
        fields["_operations"] = {
            note_key(operation, names[values]): _rate_note(worked / repeats)
            for (values, operation), worked in found.rates.items()
            if operation in found.rows[values]
        }
    table = {
        names[values]: {name: names[target] for name, target in row.items()}
        for values, row in found.rows.items()
    }
    table |= {names[values]: {} for values in lost}
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


def _rate_note(share: float) -> dict[str, Json]:
    """Return the cost and the risk of an operation. ``share`` is how many of its attempts worked,
    from 0 to 1. A campaign with this share would propose the same."""
    return {"cost": round(2.0 - share, 2), "risk": risk_word(1.0 - share)}


def _with_failures(branch: StateBranch, lost: Sequence[Values]) -> dict[str, Json]:
    """Return the notes of the facts, with the values that mean failure."""
    notes = branch.fields.get("_facts")
    found: dict[str, Json] = dict(notes) if isinstance(notes, Mapping) else {}
    for digit, alphabet in enumerate(branch.alphabet):
        values = dict.fromkeys(one[digit] for one in lost if one[digit] not in alphabet)
        if values:
            own = found.get(str(digit))
            note = dict(own) if isinstance(own, Mapping) else {}
            known = note.get("failure", [])
            note["failure"] = list(dict.fromkeys([*known, *values]))
            found[str(digit)] = note
    return found


@dataclass(frozen=True)
class PhysicsDifference:
    """Edges of another blueprint that were not found, and edges that it does not have."""

    edges: int
    missing: tuple[str, ...]
    false: tuple[str, ...]


def against(
    explored: Blueprint, other: Blueprint, idle: Collection[tuple[Values, str]] = ()
) -> PhysicsDifference:
    """Compare the edges of two blueprints of one State Branch, by facts and operation names.

    An edge that leads back to the same facts is not missing if the exploration has found that its
    operation is ``idle`` there: it returned and changed no fact.
    """
    if len(other) != 1:
        raise PlanningError(f"edges are compared with one State Branch, not {len(other)}")
    ours, theirs = _edges(explored), _edges(other)
    return PhysicsDifference(
        len(ours),
        tuple(
            address
            for (source, operation, target), address in theirs.items()
            if (source, operation, target) not in ours
            and not (source == target and (source, operation) in idle)
        ),
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
