"""What an operation loses if it gets a new name. The person reads it before the rename."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.editing.renames import replaced_words
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.words import series


class RenameWarning:
    """Warns once about a rename. The second try of the same rename is the person's yes."""

    def __init__(self) -> None:
        self.loaded = Loaded()
        """The plugins whose functions may be bound by the name."""
        self._told: object = None

    def once(
        self, blueprint: Blueprint, chosen: Sequence[Address], new: str, agreed: bool = True
    ) -> str:
        """Return the words of the warning, or an empty text if there is nothing to warn about.

        ``chosen`` are edges with one name, ``new`` is their new name. The second try of the same
        rename gets an empty text too, unless ``agreed`` is False: then it is not a yes.
        """
        told = (tuple(chosen), new)
        words = lost_by_name(blueprint, chosen, new, self.loaded)
        if not words or (agreed and told == self._told):
            self._told = None
            return ""
        self._told = told
        return f"{words} Enter again renames it."


def lost_by_name(blueprint: Blueprint, chosen: Sequence[Address], new: str, loaded: Loaded) -> str:
    """Return sentences about what edges with one name lose if they get the name ``new``."""
    from smsl_studio.library.by_name import function_by_name

    old = chosen[0].operation
    if not new or new == old:
        return ""
    sentences = []
    replaced = dict.fromkeys(word for edge in chosen for word in _replaced(blueprint, edge, new))
    if replaced:
        other = "another value" if len(replaced) == 1 else "other values"
        sentences.append(f"{new} has {other} of {series(list(replaced))}, which will count here.")
    branch = blueprint[chosen[0].branch]
    function = function_by_name(loaded, branch, old)
    bound = all(branch.operation_note(one.state, old).binding for one in chosen
                if one.branch == branch.name)  # fmt: skip
    if function and not bound and not function_by_name(loaded, branch, new):
        sentences.append(f"{function} is bound by the name {old}, and nothing by {new}.")
    return " ".join(sentences)


def _replaced(blueprint: Blueprint, edge: Address, new: str) -> list[str]:
    """Return the words of an edge that have another value in the entry of the name ``new``."""
    table = blueprint[edge.branch].fields.get("_operations")
    notes = table if isinstance(table, dict) else {}
    own = notes.get(note_key(edge.operation, edge.state))
    said = own if isinstance(own, dict) else {}
    words = replaced_words(notes.get(note_key(edge.operation)), notes.get(note_key(new)))[1]
    return [word for word in words if word not in said]
