"""Recovering a journal: what it would bring back, and bringing it back."""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import dataclass
from hashlib import sha256
from itertools import count
from pathlib import Path

from smsl_studio.blueprint.comparison import Change, Difference, compare
from smsl_studio.blueprint.drawn import GROUPS, NOTES
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.picture.aligned import as_drawn
from smsl_studio.smsl.disk import write_new
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.inputs import read_ordinary
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.broken import Broken, faults_of, read_text
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.opened_file import OpenedFile, open_file, understood
from smsl_studio.studio.document.journal.entry import JournalEntry, KeptText
from smsl_studio.studio.document.session import Session

LARGE = 4 << 20
"""From this number of characters on, the offer shows the size instead of a comparison."""
NOUNS = {"branch": "State Branch", "header": "header field"}
PLURALS = {"branch": ("State Branches",)}
DRAWN = {GROUPS: "group", NOTES: "note"}
STEP = "Recover unsaved work"


@dataclass(frozen=True)
class KeptSides:
    """The blueprint on the disk (None if it cannot be read), and the blueprint with the kept
    texts."""

    before: OpenedFile | None
    after: OpenedFile

    @property
    def comparable(self) -> bool:
        """Whether both sides are blueprints."""
        return self.before is not None and not (self.before.broken or self.after.broken)


@dataclass(frozen=True)
class Restored:
    """The result of a recovery.

    ``lost`` are texts of files that the blueprint does not have, or that cannot be shown in it.
    ``changed`` are files that another program has written since.
    """

    lost: tuple[KeptText, ...]
    changed: tuple[str, ...]


@dataclass(frozen=True)
class Brings:
    """What a recovery would bring back, in words, and whether both sides can be compared."""

    words: str
    comparable: bool


def sides(entry: JournalEntry) -> KeptSides:
    """Both sides of a journal, read."""
    own = own_text(entry)
    before = on_disk(entry)
    if before is None or own is not None:
        text = own.text if own is not None else ""
        after = understood(text, entry.path or entry.file)
    else:
        after = before
    for kept in entry.texts:
        if kept is not own:
            after = _with(after, kept)
    return KeptSides(before, after)


def on_disk(entry: JournalEntry) -> OpenedFile | None:
    """The blueprint at the journal's place on the disk; None if it cannot be read."""
    if not entry.path:
        return None
    try:
        return open_file(Path(entry.path))
    except ReadError:
        return None


def own_text(entry: JournalEntry) -> KeptText | None:
    """The kept text of the blueprint's own file; None if that was saved."""
    return next((kept for kept in entry.texts if kept.file == entry.file), None)


def brings(entry: JournalEntry) -> Brings:
    """What a recovery of this journal would bring back."""
    if sum(len(kept.text) for kept in entry.texts) > LARGE:
        size = sum(len(kept.text) for kept in entry.texts) / (1 << 20)
        return Brings(f"{counted(len(entry.texts), 'text')} of {size:.1f} MB", bool(entry.path))
    both = sides(entry)
    words = _changes(entry, both)
    if entry.path and both.before is None:
        words += " The file is no longer there."
    elif any(_moved_on(kept, entry) for kept in entry.texts):
        words += " The file was changed on the disk since."
    return Brings(words, both.comparable)


def is_saved(entry: JournalEntry) -> bool:
    """Whether all kept texts are in their files: the window ended right after a save."""
    return bool(entry.path) and all(_stands(kept) for kept in entry.texts)


def restore(entry: JournalEntry, files: Files, session: Session) -> Restored:
    """Open the file on the disk and apply the kept texts as unsaved changes.

    Each text is one step that can be undone.
    """
    before = on_disk(entry)
    path = Path(entry.path) if entry.path else None
    own = own_text(entry)
    if before is not None:
        files.show(before, path, entry.name)
    else:
        text = own.text if own is not None else ""
        files.show(understood(text, entry.path or entry.file), path, entry.name)
        if path is not None:
            files.on_disk.saw(session.blueprint.file, None)
        session.history.resetClean()
    waiting = sorted(entry.texts, key=lambda kept: kept is not own)
    lost, changed = [], []
    for kept in _whole_first(session.blueprint, waiting):
        file = _file_of(session.blueprint, kept, entry)
        if file is None:
            lost.append(kept)
            continue
        if session.texts[file] != kept.text:
            session.write(STEP, kept.text, file)
        if session.texts.get(file) != kept.text:  # refused: another text is broken
            lost.append(kept)
        elif _moved_on(kept, entry):
            changed.append(file)
    files.changed.emit()
    return Restored(tuple(lost), tuple(changed))


def keep_text(kept: KeptText, home: Path) -> Path:
    """Write a text that belongs to no file any more into a file of its own; returns the path.

    Raises OSError if the user's folder cannot be written.
    """
    folder = home / "recovered"
    folder.mkdir(parents=True, exist_ok=True)
    name = Path(kept.file)
    numbers = (f"-{number}" if number else "" for number in count())
    paths = (folder / f"{name.stem[:60]}{number}{name.suffix[:9]}" for number in numbers)
    path = next(path for path in paths if not os.path.lexists(path))
    write_new(path, kept.text.encode("utf-8", "surrogatepass"), 0o600)
    return path


def _with(opened: OpenedFile, kept: KeptText) -> OpenedFile:
    file = _file_of(opened.blueprint, kept, None)
    if file is None:
        return opened
    reading = read_text(opened.blueprint, file, kept.text)
    if isinstance(reading, Broken):
        return OpenedFile(opened.blueprint, opened.broken or reading)
    return OpenedFile(reading, opened.broken)


def _file_of(blueprint: Blueprint, kept: KeptText, entry: JournalEntry | None) -> str | None:
    """The name of the document to which a kept text belongs; None if the blueprint has none."""
    if entry is not None and kept.file == entry.file:
        return blueprint.file
    for document in blueprint.documents:
        if os.path.abspath(document.file) == kept.file:  # noqa: PTH100
            return document.file
    return None


def _whole_first(blueprint: Blueprint, waiting: list[KeptText]) -> list[KeptText]:
    """Put a broken text last, because only one text may be broken at a time."""

    def broken(kept: KeptText) -> bool:
        """Whether a kept text cannot be read."""
        return understood(kept.text, kept.file).broken is not None

    return sorted(waiting, key=broken) if len(waiting) > 1 else waiting


def _changes(entry: JournalEntry, both: KeptSides) -> str:
    after = both.after
    if after.broken is not None:
        return f"{faults_of(after.broken).capitalize()}: it cannot be read as a blueprint."
    if both.before is None:
        blueprint = after.blueprint
        there = f"{counted(blueprint.state_count, 'state')} and " \
                f"{counted(blueprint.operation_count, 'operation')}"  # fmt: skip
        return there if entry.path else f"Never saved: {there}."
    if both.before.broken is not None:
        return "The text reads as a blueprint again."
    return tallied(as_drawn(compare(both.before.blueprint, after.blueprint)))


def tallied(found: Difference) -> str:
    """The number of changes of each kind, such as "2 states added, 1 operation retargeted"."""
    if found.same:
        return "Order, comments or spelling."
    counts = Counter((_what(change), change.kind.value)
                     for change in (*found.changes, *found.fields))  # fmt: skip
    parts = [f"{counted(n, NOUNS.get(what, what), *PLURALS.get(what, ()))} {happened}"
             for (what, happened), n in counts.items()]  # fmt: skip
    if found.moved:
        parts.append(f"{counted(len(found.moved), 'state')} moved in the layout")
    if found.redrawn:
        parts.append(f"{counted(len(found.redrawn), 'operation')} redrawn")
    if found.pinned:
        parts.append(f"{counted(len(found.pinned), 'state')} pinned or unpinned")
    return f"{', '.join(parts)}."


def _what(change: Change) -> str:
    """What has changed, in a word of the window: a group and a note are fields in the file."""
    path = change.path_after or change.path_before
    return DRAWN.get(str(path[-2]), change.what) if len(path) > 1 else change.what


def _moved_on(kept: KeptText, entry: JournalEntry) -> bool:
    """Whether another program has written the file since."""
    if not entry.path and kept.file == entry.file:
        return False
    now = _digest(kept.file)
    return bool(now) and now != kept.saved


def _stands(kept: KeptText) -> bool:
    text = kept.text.encode("utf-8", "surrogatepass")
    return sha256(text).hexdigest() == _digest(kept.file)


def _digest(file: str) -> str:
    try:
        return sha256(read_ordinary(file, LARGEST_FILE).raw).hexdigest()
    except (OSError, ValueError):
        return ""
