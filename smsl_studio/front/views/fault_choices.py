"""What can be chosen for a fault: what goes wrong, with which fact, and at which moment.

A choice becomes one line of a script. So a fault that is injected by hand is the same as one from a
script.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.errors import UsageError
from smsl_studio.front.script.script import AT, DURING, WHEN
from smsl_studio.front.script.words import apart
from smsl_studio.front.views.fact_tiles import value_words
from smsl_studio.front.views.states import short_name
from smsl_studio.library.bound import leaf_facts
from smsl_studio.world.engines import TABLE

Json = Any
Choice = tuple[str, Any]
"""The words of a choice, and its value."""
INJECT, DISTURB = "inject", "disturb"
SET, ELSEWHERE, STUCK = "set", "elsewhere", "stuck"
SENSORS: Mapping[str, str] = {
    STUCK: "A fact is read wrongly",
    "dropout": "A fact is not read any more",
    "none": "A fact is read rightly again",
}
"""The disturbances of sensors that are offered, in words."""
FAULTS: Mapping[str, str] = {
    SET: "A fact changes, until an operation writes it",
    "fail": "The operation says that it failed",
    "raise": "The operation breaks off with an error",
    "hang": "The operation never ends",
    "nothing": "The operation changes nothing and says that all is well",
    ELSEWHERE: "The operation ends in another state",
}
"""The faults of the table world in words. Those of an operation befall the one that runs, or else
the next one."""
NOW, AFTER, WHILE = "now", "after", "while"
MOMENTS: Mapping[str, str] = {
    NOW: "Now",
    AFTER: "After an operation",
    WHILE: "While an operation runs",
}
EXAMPLE = "such as peg=c seconds=6"
MOST = 200
"""The largest number of operations that are offered."""


@dataclass(frozen=True)
class FaultChoice:
    """A chosen fault: the command with its arguments, its moment, and the operation that the moment
    is about."""

    do: str
    given: Mapping[str, float | str]
    moment: str = NOW
    operation: Address | None = None


def fault_choices(faults: Sequence[str], sensed: bool) -> list[Choice]:
    """Return what can go wrong in a world, in words. The value is a command and its kind.

    ``faults`` are those of the world. ``sensed`` says whether it has sensors to disturb.
    """
    table = set(faults) == set(FAULTS)
    disturbed = [(words, (DISTURB, kind)) for kind, words in SENSORS.items()] if sensed else []
    named = [(FAULTS[name] if table else name.replace("_", " "), name) for name in faults]
    return [*disturbed, *((words, (INJECT, name)) for words, name in named)]


def fact_choices(blueprint: Blueprint) -> list[Choice]:
    """Return the facts that are sensed, by name. The value is the ``FactKey``."""
    several = len(blueprint) > 1
    return [
        (f"{branch.name} {branch.fact_name(digit)}" if several else branch.fact_name(digit),
         (branch.name, digit))
        for branch, digit in leaf_facts(blueprint)
    ]  # fmt: skip


def value_choices(blueprint: Blueprint, key: FactKey) -> list[Choice]:
    """Return the values of a fact with their meanings: those of the states, and those that
    ``_facts`` declares besides."""
    branch, note = blueprint[key[0]], blueprint[key[0]].fact_note(key[1])
    declared = (*note.values, *note.failure) if note is not None else ()
    values = dict.fromkeys((*branch.alphabet[key[1]], *declared))
    return [(value_words(blueprint, key, value), value) for value in values]


def operation_choices(blueprint: Blueprint, status: DispatchStatus) -> list[Choice]:
    """Return the operations that may come: the one that runs, the route, what is possible."""
    found = islice(dict(_ahead(blueprint, status)).items(), MOST)
    return [(words, address) for address, words in found]


def _ahead(blueprint: Blueprint, status: DispatchStatus) -> Iterator[tuple[Address, str]]:
    """Yield operations in words. Of an operation that comes twice, the last words count."""
    several = len(blueprint) > 1
    possible = [one.address for one in status.possible]
    ahead = [*([status.running] if status.running else ()), *status.route, *possible]
    for number, address in enumerate(dict.fromkeys(ahead)):
        branch = blueprint[address.branch]
        source = short_name(branch, address.state)
        where = f"{branch.name} {source}" if several else source
        running = ", runs now" if address == status.running else ""
        following = ", next" if not running and number == 0 else ""
        yield address, f"{address.operation} from {where}{running}{following}"


def undone_words(choice: FaultChoice, status: DispatchStatus, world: str) -> str:
    """Return that the operation takes the fault back, or the empty text.

    An operation of the table world writes all facts of its SB when it ends.
    """
    during = status.running if choice.moment == NOW else choice.operation
    if world != TABLE or choice.given.get("fault") != SET or during is None:
        return ""
    key = split_fact(str(choice.given.get("fact", "")))
    if choice.moment == AFTER or key is None or key[0] != during.branch:
        return ""
    return f"{during.operation} writes every fact of {during.branch} when it ends, this one too"


def fault_line(
    choice: FaultChoice, status: DispatchStatus, blueprint: Blueprint, by: str
) -> Mapping[str, Json]:
    """Return the line of a script that lets something go wrong at its moment.

    An operation that runs already has begun, so the moment is now. Otherwise the line means the
    next time.
    """
    moment: Mapping[str, Json] = {AT: round(status.time, 6)}
    edge = choice.operation
    if choice.moment == WHILE and edge is not None and edge != status.running:
        moment = {DURING: str(edge)}
    elif choice.moment == AFTER and edge is not None:
        target = blueprint[edge.branch].table[edge.state][edge.operation]
        moment = {WHEN: str(Address(edge.branch, target))}
    return {**moment, "do": choice.do, **apart(choice.do, choice.given), "by": by}


def parameters_of(text: str) -> dict[str, float | str]:
    """Return the parameters in a text such as ``peg=c seconds=6``, separated by spaces or commas.

    UsageError if a part is not name=value.
    """
    found: dict[str, float | str] = {}
    for part in text.replace(",", " ").split():
        name, sign, value = part.partition("=")
        if not name.isidentifier() or not sign or not value:
            raise UsageError(f"{part} is no name=value, {EXAMPLE}")
        found[name] = _value(value)
    return found


def _value(text: str) -> float | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
