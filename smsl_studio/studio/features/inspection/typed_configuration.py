"""Reads and writes a configuration as text: states with commas between them."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import UsageError
from smsl_studio.front.views.states import short_name

HOW = "Write states with commas between them, such as SB1/State_0, SB2/State_1."


def written_configuration(configuration: Mapping[str, str]) -> str:
    """Return the text of a configuration. ``typed_configuration`` can read it."""
    return ", ".join(str(Address(name, state)) for name, state in configuration.items())


def typed_configuration(blueprint: Blueprint, text: str) -> dict[str, str]:
    """Return the states that a text names, by their SBs.

    A state is written ``SB/State``. The SB may be left out if only one SB has such a state. The
    facts of a state may be written instead of its name. UsageError if the text is anything else.
    """
    found: dict[str, str] = {}
    for part in filter(None, (one.strip() for one in text.split(","))):
        branch, state = _one(blueprint, part)
        if found.get(branch, state) != state:
            raise UsageError(f"{branch} is named twice, with {found[branch]} and {state}", None,
                             "Name each State Branch once.")  # fmt: skip
        found[branch] = state
    if not found:
        raise UsageError("no state is named", None, HOW)
    return found


def _one(blueprint: Blueprint, part: str) -> tuple[str, str]:
    names = Address.split(part)
    if len(names) > 2 or not all(names):
        raise UsageError(f"“{part}” is no state", None, HOW)
    if len(names) == 2 and names[0] not in blueprint.branches:
        raise UsageError(f"there is no State Branch {names[0]}", None, HOW)
    among = [blueprint[names[0]]] if len(names) == 2 else list(blueprint)
    found = [(one.name, state) for one in among for state in _states(one, names[-1])]
    if len(found) == 1:
        return found[0]
    if not found:
        where = names[0] if len(names) == 2 else "the drawing"
        raise UsageError(f"{where} has no state {names[-1]}", None, HOW)
    some = " or ".join(str(Address(*one)) for one in found[:3])
    raise UsageError(f"{names[-1]} can be more than one state", None, f"Write {some}.")


def _states(branch: StateBranch, name: str) -> list[str]:
    if name in branch.table:
        return [name]
    return [state for state in branch.table if short_name(branch, state) == name]
