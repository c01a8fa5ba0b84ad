"""Facts by their names: the step that renames one, and the sentence that tells when it is on."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.model import Blueprint, StateBranch


def fact_name_step(
    branch: str, digit: int, text: str
) -> tuple[str, Callable[[Blueprint], Blueprint]]:
    """The words of the step that renames a fact, and its change of the blueprint.

    An empty text, or the default name (such as “Fact 1”), removes the name.
    """
    name = "" if text == f"Fact {digit + 1}" else text
    words = f"Name digit {digit} “{name}”" if name else f"Leave digit {digit} without a name"
    changes = {(branch, str(digit)): {"name": name or None}}
    return words, lambda blueprint: change_notes(blueprint, "_facts", changes)


def expansion(blueprint: Blueprint, branch: StateBranch, digit: int, sub: str) -> str:
    """A sentence that explains when the fact is on, if a sub-SB expands it."""
    if sub not in blueprint.branches:
        return f"{sub} is no State Branch of this blueprint."
    state = blueprint[sub].activating or "not drawn yet"
    return (
        f"“{branch.fact_name(digit)}” is on exactly while {sub} stands in its "
        f"activating state, {state}."
    )
