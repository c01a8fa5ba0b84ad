"""The user's store as lines of a list: each blueprint with its mark, and its swept operations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from smsl_studio.blueprint.stored import PREFIX, stored_folder
from smsl_studio.errors import SealError
from smsl_studio.front.former_record import file_stamp
from smsl_studio.home import user_folder
from smsl_studio.stop import heed

if TYPE_CHECKING:
    from smsl_studio.inspection.approval.shelf import StoredBlueprint

MOST = 500
"""At most so many blueprints are listed; ``store find`` finds the others."""


@dataclass(frozen=True)
class StoredLine:
    """A stored blueprint, or an operation of it that was swept.

    ``name`` is what a binding or an import writes (empty: the store cannot be read). ``mark`` says
    whether the blueprint is approved or what the sweep showed; ``is_good`` whether that is well.
    ``withdrawn``: it is revoked, or not what was stored, and must not be used. ``words`` are the
    texts by which it is found. ``told`` says more, in sentences.
    """

    title: str
    name: str
    mark: str
    is_good: bool = False
    withdrawn: bool = False
    operation: bool = False
    words: tuple[str, ...] = ()
    told: str = ""


def store_stamps() -> tuple[object, ...]:
    """Return a value that changes with what the store holds and revokes. Nothing is read."""
    store = user_folder() / "store"
    return tuple(map(file_stamp, (stored_folder(), store / "revoked.json", store / "keys")))


def stored_lines() -> tuple[StoredLine, ...]:
    """Return the lines of all stored blueprints, each followed by its operations.

    The whole check is run for each blueprint with a record, so it may take long. It heeds a stop.
    """
    from smsl_studio.inspection.approval.shelf import stored_blueprints

    try:
        stored = stored_blueprints()
    except SealError as error:
        told = f"{error.sentence}. {error.advice}"
        return (StoredLine("The store cannot be read", "", "", told=told),)
    return tuple(line for entry in stored[:MOST] for line in _lines(entry))


def _lines(entry: StoredBlueprint) -> Iterator[StoredLine]:
    from smsl_studio.front.store_shelf import ANOTHER_CONTENT, REVOKED, mark_of

    heed()
    said = mark_of(entry)
    name, words = f"{PREFIX}{entry.digest}", tuple(entry.words)
    told = " ".join(_sentence(one) for one in (*said.lines[1:], *_swept(entry)))
    gone = said.words in (REVOKED, ANOTHER_CONTENT)
    yield StoredLine(entry.title, name, said.words, said.is_good, gone, words=words, told=told)
    for sweep in entry.verified:
        for one in sweep.operations:
            all_well = one.passed == one.edges
            found = f"{one.passed} of {one.edges} in {sweep.world}"
            # What is revoked must not be used, whatever a sweep has shown before.
            mark = said.words if gone else found
            more = f"It is an operation of {entry.title}. {found} passed: {sweep.words}."
            yield StoredLine(
                one.operation, name, mark, all_well and not gone, gone, True, told=more
            )


def _swept(entry: StoredBlueprint) -> Iterator[str]:
    for one in entry.verified:
        yield one.words


def _sentence(text: str) -> str:
    return text if text.endswith((".", "!", "?")) else f"{text}."
