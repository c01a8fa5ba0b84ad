"""What is only drawn of one SB: notes (``_notes``) and groups (``_groups`` in ``_layout``).

No digest covers them. They are read only if somebody asks for them.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from smsl_studio.blueprint.annotations import DrawnNote, Group

Json = Any
NOTES, LAYOUT, GROUPS = "_notes", "_layout", "_groups"
Faults = list[tuple[tuple[str, ...], str]]


@dataclass(frozen=True)
class Drawn:
    """The notes and groups of one SB by key, in written order, and the faults in them with paths.

    A note hangs only on a state that exists; others are free. A state is only in the first group
    that has it, and each group has states.
    """

    notes: Mapping[str, DrawnNote] = field(default_factory=dict)
    groups: Mapping[str, Group] = field(default_factory=dict)
    faults: tuple[tuple[tuple[str, ...], str], ...] = ()

    def __bool__(self) -> bool:
        return bool(self.notes or self.groups)

    def group_of(self, state: str) -> str:
        """Return the key of the group in which a state stands, empty for none."""
        return next((key for key, group in self.groups.items() if state in group.states), "")

    def notes_on(self, state: str) -> tuple[str, ...]:
        """Return the keys of the notes that hang on a state."""
        return tuple(key for key, note in self.notes.items() if note.state == state)


NOTHING_DRAWN = Drawn()
"""What an SB has that has neither notes nor groups."""


def written_groups(layout: Json) -> Json:
    """Return what stands under ``_groups`` in a ``_layout``, None if nothing does."""
    return layout.get(GROUPS) if isinstance(layout, dict) else None


def read_drawn(fields: Mapping[str, Json], states: Container[str]) -> Drawn:
    """Return the notes and groups in an SB's ``_`` fields. ``states`` has its states."""
    raw_notes, raw_groups = fields.get(NOTES), written_groups(fields.get(LAYOUT))
    if raw_notes is None and raw_groups is None:
        return NOTHING_DRAWN
    faults: Faults = []
    notes = _notes(raw_notes, states, faults)
    return Drawn(notes, _groups(raw_groups, states, faults), tuple(faults))


def _table(raw: Json, path: tuple[str, ...], faults: Faults) -> Mapping[str, Json]:
    """Return a map. Another value is a fault, but for None."""
    if raw is not None and not isinstance(raw, dict):
        faults.append((path, f"{path[-1]} must be a map"))
    return raw if isinstance(raw, dict) else {}


def _notes(raw: Json, states: Container[str], faults: Faults) -> dict[str, DrawnNote]:
    from smsl_studio.blueprint.annotations import DrawnNote, validated

    found: dict[str, DrawnNote] = {}
    for key, entry in _table(raw, (NOTES,), faults).items():
        note = validated(DrawnNote, entry, (NOTES, key), faults)
        if note is not None and note.state and note.state not in states:
            faults.append(((NOTES, key), f"it hangs on {note.state}, which is no state"))
            note = replace(note, state="")
        if note is not None:
            found[key] = note
    return found


def _groups(raw: Json, states: Container[str], faults: Faults) -> dict[str, Group]:
    from smsl_studio.blueprint.annotations import Group, validated

    found: dict[str, Group] = {}
    taken: set[str] = set()
    for key, entry in _table(raw, (LAYOUT, GROUPS), faults).items():
        path = (LAYOUT, GROUPS, key)
        group = validated(Group, entry, path, faults)
        if group is None:
            continue
        known = dict.fromkeys(name for name in group.states if name in states)
        own = tuple(name for name in known if name not in taken)
        if len(known) != len(group.states):
            faults.append((path, "it names a state twice, or one that does not exist"))
        elif len(own) != len(known):
            faults.append((path, "it names a state that stands in another group already"))
        if own:
            taken.update(own)
            found[key] = replace(group, states=own)
    return found
