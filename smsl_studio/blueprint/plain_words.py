"""Names of states that are words, such as ``Idle``, where nothing says that they are facts."""

from __future__ import annotations

from smsl_studio.blueprint.model import StateBranch


def is_plain_word(branch: StateBranch, name: str) -> bool:
    """Return whether a name is a word or several, whose letters would mean nothing as facts.

    It has letters and spaces only, and neither the header nor an annotation speaks of facts.
    """
    shape = branch.shape
    said = shape.width != 1 or shape.written is not None or branch.subs or branch.notes.facts
    return not said and name.replace(" ", "").isalpha() and not name.startswith("State")
