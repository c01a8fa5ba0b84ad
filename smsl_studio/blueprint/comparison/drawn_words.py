"""The words for a change of a note or of a group on the drawing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.comparison.values import said
from smsl_studio.blueprint.drawn import NOTES

Json = Any
_NAMED = 3
"""So many states that came into a group or left it are named."""


def drawn_words(table: str, branch: str, old: Json, new: Json) -> str:
    """Return a sentence about a note (``table`` is ``_notes``) or a group of an SB.

    ``old`` and ``new`` are the entries on both sides, None where there is none. The sentence is
    empty if an entry has a form that is not known.
    """
    shown = old if new is None else new
    if not all(one is None or isinstance(one, Mapping) for one in (old, new)):
        return ""
    note = table == NOTES
    name = _first(shown.get("text" if note else "title", ""))
    subject = f"The {'note' if note else 'group'}" + (f" “{name}”" if name else "")
    if old is None:
        return f"{subject} is added to {branch}."
    if new is None:
        return f"{subject} of {branch} is removed."
    told = list(_note_words(old, new) if note else _group_words(old, new))
    return f"{subject} of {branch} {' and '.join(told) or 'is changed'}."


def _note_words(old: Mapping[str, Json], new: Mapping[str, Json]) -> Iterator[str]:
    text, state = old.get("text", ""), new.get("state", "")
    if text != new.get("text", ""):
        yield f"said “{_first(text)}” before"
    if state != old.get("state", ""):
        yield f"hangs on {said(state)}" if state else "hangs on no state"
    elif old.get("at") != new.get("at"):
        yield "stands elsewhere"
    for key in ("author", "date"):
        if old.get(key, "") != new.get(key, ""):
            yield f"has the {key} {said(new.get(key, '')) or 'nothing'}"


def _group_words(old: Mapping[str, Json], new: Mapping[str, Json]) -> Iterator[str]:
    title = old.get("title", "")
    if title != new.get("title", ""):
        yield f"was called “{said(title)}” before"
    before, after = _states(old), _states(new)
    came = [name for name in after if name not in before]
    left = [name for name in before if name not in after]
    if came:
        yield f"has {_listed(came)} too"
    if left:
        yield f"no longer has {_listed(left)}"


def _states(entry: Mapping[str, Json]) -> dict[str, None]:
    found = entry.get("states")
    return dict.fromkeys(map(said, found)) if isinstance(found, list | tuple) else {}


def _listed(names: list[str]) -> str:
    if len(names) > _NAMED:
        return f"{len(names)} states"
    return " and ".join((", ".join(names[:-1]), names[-1])) if len(names) > 1 else names[0]


def _first(text: Json) -> str:
    """Return the first line of a text."""
    return said(text).partition("\n")[0]
