"""The partial view of one State Branch, from the status of a run. Pure functions, no widget.

It has the former state, the active state, every operation out of it, and the states that these lead
to.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Term
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.front.views.cost_words import cost_words
from smsl_studio.picture.sub_marks import sub_mark

RUNNING, PAUSED, WAITS, UNKNOWN, PRUNED, RISKY, VETOED, REFUSED, NEXT, POSSIBLE = (
    "running", "paused", "waits", "unknown", "pruned", "risky", "vetoed", "refused", "next",
    "possible",
)  # fmt: skip
PROPOSED = "proposed"
"""The operation is none of the blueprint, and people are asked whether it may count in this run."""
ACTORS = {"human": "human", "shared": "shared", "robot": "robot", "automatic": "robot"}
ONE_AT_A_TIME = "one operation at a time"
NUMBERED = 9
"""The largest number of operations with a key on the keyboard."""


@dataclass(frozen=True)
class OperationCard:
    """One operation out of the active state.

    ``standing`` is one of the words above, and ``reasons`` say why the operation is not permitted.
    ``mark`` is ``rise``, ``fall``, ``mixed`` or empty. ``actor`` is ``human``, ``shared`` or
    ``robot``. ``cost`` is empty if the operation only moves a sub-SB. ``needs`` says in few words
    what it requires, and is empty for nothing. ``unmet`` is ``unknown`` or ``missing`` if this is
    not given now.
    """

    address: Address
    number: int
    target: str
    mark: str
    risk: str
    cost: str
    actor: str
    needs: str
    standing: str
    unmet: str = ""
    reasons: tuple[str, ...] = ()
    on_route: bool = False

    @property
    def name(self) -> str:
        """The name of the operation."""
        return self.address.operation

    @property
    def stays(self) -> bool:
        """Whether the operation leads back to the state it leaves."""
        return self.target == self.address.state

    @property
    def permitted(self) -> bool:
        """Whether the operation may be chosen now."""
        return self.standing in (NEXT, POSSIBLE)


@dataclass(frozen=True)
class PartialView:
    """The content of the page Supervise for one SB.

    ``via`` is the edge that led here, None at the start. ``neighbours`` are the states that the
    cards lead to, in order and each once. ``ahead`` is the next state. ``seconds`` is the simulated
    time since the active state was entered.
    """

    branch: str
    state: str
    title: str
    seconds: float
    via: Address | None
    via_mark: str
    cards: tuple[OperationCard, ...]
    neighbours: tuple[str, ...]
    ahead: str = ""

    def card(self, address: Address | None) -> OperationCard | None:
        """Return the card of an operation, None if it does not leave the active state."""
        return next((card for card in self.cards if card.address == address), None)

    def numbered(self, number: int) -> OperationCard | None:
        """Return the card with this number, None if there is none."""
        return self.cards[number - 1] if 0 < number <= len(self.cards) else None


@dataclass(frozen=True)
class OutsideFact:
    """A fact of another SB that an operation requires and that does not hold."""

    term: Term
    name: str
    words: str
    blocks: tuple[str, ...]


def shown_branch(status: DispatchStatus, chosen: str = "", before: str = "") -> str:
    """Return the SB to show: the chosen one, else one where something happens or happens next, else
    the one shown before.
    """
    happening = (status.running, status.carrying, *status.route[:1])
    names = (one.branch for one in happening if one is not None)
    goals = (goal.branch for goal in status.goals)
    wanted = (chosen, _asked_about(status), *names, before, *goals)
    known = [name for name in wanted if name in status.configuration]
    return known[0] if known else next(iter(status.configuration), "")


def partial_view(blueprint: Blueprint, status: DispatchStatus, name: str) -> PartialView | None:
    """Return the partial view of one SB, None if it has no state yet."""
    state = status.configuration.get(name, "")
    branch = blueprint.branches.get(name)
    if branch is None or state not in branch.table:
        return None
    cards = _cards(blueprint, branch, status, state)
    via = status.previous.get(name)
    note = branch.state_note(state)
    nearest = _nearest(status, name)
    return PartialView(
        branch=name,
        state=state,
        title=note.title if note else "",
        seconds=max(status.time - status.since.get(name, status.time), 0.0),
        via=via,
        via_mark=_mark(branch, via) if via else "",
        cards=cards,
        neighbours=tuple(dict.fromkeys(card.target for card in cards if not card.stays)),
        ahead=branch.table[state].get(nearest.operation, "") if nearest else "",
    )


def outside_facts(
    blueprint: Blueprint, status: DispatchStatus, view: PartialView
) -> tuple[OutsideFact, ...]:
    """Return the facts of other SBs that prevent operations of this view."""
    found: dict[tuple[tuple[str, int], str], tuple[Term, list[str]]] = {}
    for item in status.possible:
        if view.card(item.address) is None:
            continue
        for term in item.needs:
            if term.truth is not True and term.fact[0] != view.branch:
                entry = found.setdefault((term.fact, term.wanted), (term, []))
                entry[1].append(item.address.operation)
    return tuple(
        OutsideFact(term, _fact_name(blueprint, term), _why(term), tuple(blocks))
        for term, blocks in found.values()
    )


def _cards(
    blueprint: Blueprint, branch: StateBranch, status: DispatchStatus, state: str
) -> tuple[OperationCard, ...]:
    """Return the cards. Operations to the same state stand together, in written order. Those that
    lead back to the active state come last.

    The order does not change during the run, so an operation keeps its number on the keyboard.
    """
    known = {item.address: item for item in status.possible}
    edges = branch.table[state]
    targets = list(dict.fromkeys(edges.values()))
    ordered = sorted(edges, key=lambda op: (edges[op] == state, targets.index(edges[op])))
    addresses = [Address(branch.name, state, operation) for operation in ordered]
    return tuple(
        _card(blueprint, branch, status, address, known.get(address), number)
        for number, address in enumerate(addresses, 1)
    )


def _card(
    blueprint: Blueprint,
    branch: StateBranch,
    status: DispatchStatus,
    address: Address,
    item: Possible | None,
    number: int,
) -> OperationCard:
    note = branch.operation_note(address.state, address.operation)
    needs, unmet = _needs(blueprint, note.confirm, item.needs if item else ())
    level = item.level if item else "automatic"
    actor = note.actor or ACTORS.get(level, "robot")
    cost = item.cost if item else branch.cost(address.state, address.operation)
    return OperationCard(
        address=address,
        number=number,
        target=branch.table[address.state][address.operation],
        mark=_mark(branch, address),
        risk=(item.risk if item else "") or note.risk or "",
        cost=cost_words(branch, address, cost),
        actor=actor if level in ("automatic", "") or note.actor else ACTORS[level],
        needs=needs,
        standing=_standing(status, address, item),
        unmet=unmet,
        reasons=_reasons(status, item),
        on_route=bool(item and item.on_route),
    )


def _standing(status: DispatchStatus, address: Address, item: Possible | None) -> str:
    if address in (status.running, status.carrying):
        return PAUSED if status.phase == "paused" else RUNNING
    if status.proposed is not None and status.proposed[0] == address:
        return PROPOSED
    if any(task.address == str(address) for task in status.tasks):
        return WAITS
    if item is None:
        return REFUSED
    if item.pruned:
        return PRUNED
    if item.risky:
        return RISKY
    if item.vetoed:
        return VETOED
    if status.running is not None or status.carrying is not None:
        return REFUSED
    if not item.permitted:
        unknown = any(term.truth is None for term in item.needs)
        return UNKNOWN if unknown else REFUSED
    return NEXT if item.address in status.route[:1] else POSSIBLE


def _reasons(status: DispatchStatus, item: Possible | None) -> tuple[str, ...]:
    """Return why an operation must not be asked for. While another operation moves, this is the
    reason.
    """
    moving = status.running or status.carrying
    if item is None or moving == item.address:
        return ()
    if moving is not None and not (item.pruned or item.risky):
        return (f"{ONE_AT_A_TIME}, {moving.operation} is under way",)
    return item.reasons


def _needs(
    blueprint: Blueprint, confirm: tuple[str, ...], needs: tuple[Term, ...]
) -> tuple[str, str]:
    """Return what an operation requires, in few words, and whether this is ``missing`` or
    ``unknown``.
    """
    names = [(_fact_name(blueprint, term), term) for term in needs]
    for name, term in names:
        if term.truth is None:
            return f"{name}?", "unknown"
    for name, term in names:
        if term.truth is False:
            return f"{name}: {term.reading}, not {term.wanted}", "missing"
    people = f"{len(confirm)} people" if len(confirm) > 1 else "".join(confirm).capitalize()
    said = [words for words in (people, *(name for name, _ in names)) if words]
    return ", ".join(said), ""


def _fact_name(blueprint: Blueprint, term: Term) -> str:
    name, digit = term.fact
    branch = blueprint.branches.get(name)
    if branch is None:
        return f"{name}/{digit}"
    note = branch.fact_note(digit)
    return note.name if note and note.name else f"Fact {digit + 1} of {name}"


def _why(term: Term) -> str:
    if term.truth is None:
        return f"unknown, {term.reason}" if term.reason else "unknown"
    return f"reads {term.reading}, must be {term.wanted}"


def _mark(branch: StateBranch, address: Address) -> str:
    target = branch.table.get(address.state, {}).get(address.operation, "")
    edge = Operation(branch.name, address.state, address.operation, target)
    return sub_mark(branch, edge)


def _nearest(status: DispatchStatus, branch: str) -> Address | None:
    """Return the next edge out of the active state of an SB: the running one, or that of the
    route.
    """
    state = status.configuration.get(branch)
    ahead = (status.running, status.carrying, *status.route)
    here = (a for a in ahead if a is not None and a.branch == branch)
    first = next(here, None)
    return first if first is not None and first.state == state else None


def _asked_about(status: DispatchStatus) -> str:
    """Return the SB of an open task."""
    about = (Address(*Address.split(task.address)).branch for task in status.tasks if task.address)
    return next(about, "")
