"""The edit that renames a fact, used by the outline and the branch header."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.model import Blueprint


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
