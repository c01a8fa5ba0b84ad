"""The faults of the table world. They work with every blueprint, for tests and exercises.

The fault ``set`` changes one fact without an operation. All other faults act on the next operation.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address, fact_text, split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.library.bound import leaf_facts
from smsl_studio.library.entries import FaultEntry
from smsl_studio.library.signature import signature_of
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.world.table import TableWorld


def table_faults(blueprint: Blueprint) -> dict[str, FaultEntry]:
    """Return the faults of the table world for a blueprint, by name.

    A fault of the next operation waits for one, if its address is given.
    """

    def set_fact(world: TableWorld, fact: str, value: str) -> None:
        """Set one sensed fact (``SB/digit``) to a value."""
        world.set_facts({_fact(blueprint, fact): value})

    def fail(world: TableWorld, operation: str = "") -> None:
        """Let the next operation report a failure."""
        world.spoil("fail", at=_operation(blueprint, operation))

    def break_down(world: TableWorld, operation: str = "") -> None:
        """Let the next operation raise an error."""
        world.spoil("raise", at=_operation(blueprint, operation))

    def hang(world: TableWorld, operation: str = "") -> None:
        """Let the next operation never end."""
        world.spoil("hang", at=_operation(blueprint, operation))

    def nothing(world: TableWorld, operation: str = "") -> None:
        """Let the next operation report success without changing a fact."""
        world.spoil("nothing", at=_operation(blueprint, operation))

    def elsewhere(world: TableWorld, state: str, operation: str = "") -> None:
        """Let the next operation report success, but set the facts of another state."""
        at = _operation(blueprint, operation)
        world.spoil("elsewhere", _facts_of(blueprint, state), at)

    named: dict[str, Callable[..., None]] = {
        "set": set_fact,
        "fail": fail,
        "raise": break_down,
        "hang": hang,
        "nothing": nothing,
        "elsewhere": elsewhere,
    }
    return {name: FaultEntry(TABLE, name, f, signature_of(f)) for name, f in named.items()}


def befallen(
    world: TableWorld, how: str, facts: Mapping[FactKey, str]
) -> Generator[None, None, bool | None]:
    """Run an operation with the fault ``how``: it fails, raises an error, hangs, does nothing, or
    sets the facts of another state.

    Only ``fail`` reports a failure. ``nothing`` and ``elsewhere`` report success.
    """
    if how == "raise":
        raise RuntimeError("it was made to raise")
    while how == "hang":
        yield
    world.set_facts(facts)
    yield from ()
    return False if how == "fail" else None


def _fact(blueprint: Blueprint, text: str) -> FactKey:
    known = [(branch.name, digit) for branch, digit in leaf_facts(blueprint)]
    key = split_fact(text)
    if key not in known:
        near = did_you_mean(text, [fact_text(*one) for one in known])
        advice = near or "Write it as SB/digit, digits counted from 0."
        raise UsageError(f"no fact called {text!r} is sensed", advice=advice)
    return key


def _operation(blueprint: Blueprint, text: str) -> str:
    """Return the address of an operation, empty for the next one. UsageError if there is none."""
    if not text:
        return ""
    branch, state, name = Address.split(text)
    known = blueprint.branches.get(branch)
    if known is None or name not in known.table.get(state, {}):
        raise UsageError(
            f"there is no operation {text!r}", advice="Write it as SB/State/Operation."
        )
    return text


def _facts_of(blueprint: Blueprint, text: str) -> dict[FactKey, str]:
    """Return the facts of a state. ``text`` is ``SB/State``, or ``State`` if the blueprint has only
    one root."""
    name, _, state = text.rpartition("/")
    if not name and len(blueprint.roots) == 1:
        name = blueprint.roots[0]
    if name not in blueprint.branches or state not in blueprint[name].table:
        near = did_you_mean(text, [f"{b.name}/{one}" for b in blueprint for one in b.table])
        raise UsageError(f"there is no state {text!r}", advice=near or "Write it as SB/State.")
    branch = blueprint[name]
    values = enumerate(branch.facts(state))
    return {(name, digit): value for digit, value in values if digit not in branch.subs}
