"""How the name of a fact is changed, in the outline and in the branch header alike."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.model import Blueprint


def fact_name_step(
    branch: str, digit: int, text: str
) -> tuple[str, Callable[[Blueprint], Blueprint]]:
    """The words of the step that gives a fact this name, and the step itself.

    The name that is shown where none is written ("Fact 1") is not written, nor is an empty one.
    """
    name = "" if text == f"Fact {digit + 1}" else text
    words = f"Name fact {digit} “{name}”" if name else f"Leave fact {digit} without a name"
    changes = {(branch, str(digit)): {"name": name or None}}
    return words, lambda blueprint: change_notes(blueprint, "_facts", changes)
