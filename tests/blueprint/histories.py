"""Random histories: edits, undo and redo over blueprints in several files and in any layout."""

from __future__ import annotations

import json
import random
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.document import Document, Member
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.splice import reconcile
from tests.blueprint.test_any_edits import random_edit
from tests.smsl.native_texts import native, plain
from tests.smsl.texts import written

Json = Any
SUFFIX = {"json": ".json", "smsl": ".smsl"}
NAMES = ["State", "State_", "S", "é ", "a/b", "->", "x y", "move-star-", "// no", "ס"]


def any_blueprint(chance: random.Random) -> Blueprint:
    """One to three files, each in one of the lossless forms and in any layout."""
    documents = []
    count = chance.choice([1, 1, 2, 3])
    for number in range(count):
        form = chance.choice(["json", "smsl"])
        values = _file(chance, f"F{number}", count)
        if number == 0 and count > 1:
            # The names have a place and no form: which one a text is in is told to its reader.
            values = {"_imports": [f"part{n}" for n in range(1, count)], **values}
        seed = chance.randrange(10**9)
        text = written(values, seed) if form == "json" else native(plain(values), seed)
        documents.append(form_named(form).parse(text, f"part{number}"))
    return read_blueprint(documents[0], opened=documents[1:])


def _file(chance: random.Random, prefix: str, files: int) -> dict[str, Json]:
    values: dict[str, Json] = {}
    for number in range(chance.randrange(1, 4)):
        values[f"{prefix}{number}"] = _branch(chance, files)
        if chance.random() < 0.2:
            values[f"_note{number}"] = chance.choice([1, "x // y", [1, {"a": None}]])
    if chance.random() < 0.3:
        values["_hazards"] = [{"name": "both", "facts": {f"{prefix}0/0": "1", "F0/1": "0"}}]
    return values


def _branch(chance: random.Random, files: int) -> dict[str, Json]:
    name, count = chance.choice(NAMES), chance.randrange(0, 6)
    states = [f"{name}{number:03b}" for number in range(count)]
    branch: dict[str, Json] = {}
    if chance.random() < 0.7:
        header: dict[str, Json] = {}
        branch["HEADER"] = header
        if states and chance.random() < 0.5:
            header["INITIAL"] = chance.choice(states)
        if chance.random() < 0.4:
            header["NUM_FACTS"] = 3
        if chance.random() < 0.4:
            header["SUB_SBS"] = {f"F{chance.randrange(files)}0": chance.randrange(3)}
        if chance.random() < 0.2:
            header["_why"] = "so"
    for state in states:
        names = chance.sample(NAMES, chance.randrange(4))
        branch[state] = {operation: chance.choice(states) for operation in names}
        if chance.random() < 0.1:
            branch[state]["_odd"] = {"a": 1}
    if states and chance.random() < 0.4:
        branch["_states"] = {chance.choice(states): {"title": "t"}}
        branch["_operations"] = {chance.choice(NAMES).replace("/", "~1"): {"cost": 2}}
    if states and chance.random() < 0.5:
        branch["_layout"] = {state: [chance.randrange(999), 0.5] for state in states}
        edges = [note_key(name, state) for state in states for name in branch[state]]
        if edges and chance.random() < 0.3:
            line = {"bends": [[chance.randrange(99), 1]], "label": [0.5, 0, -9.5]}
            branch["_layout"]["_operations"] = {chance.choice(edges): line}
    if states and chance.random() < 0.4:
        note = {"text": "n", "at": [1, 2], "state": chance.choice([*states, "gone"])}
        branch["_notes"] = {"1": note, "odd": chance.choice([None, {"text": "free", "at": [3, 4]}])}
        group = {"title": "g", "states": chance.sample(states, min(2, len(states)))}
        branch.setdefault("_layout", {})["_groups"] = {"1": group}
    return branch


def stand(blueprint: Blueprint) -> str:
    """Everything that must be the same again: texts, digests, layout, order."""
    states = [
        [one.name, list(one.notes.layout.items()), repr(one.notes.edges), str(one.drawn),
         one.shape, one.alphabet,
         [one.facts(name) for name in one.table]]
        for one in blueprint
    ]  # fmt: skip
    texts = [[one.file, one.text] for one in blueprint.documents]
    return json.dumps([texts, digests(blueprint).as_json(), states, list(blueprint.branches)])


@dataclass
class History:
    """Blueprints one after the other, and how each of them stood when it was new."""

    blueprint: Blueprint
    steps: list[tuple[Blueprint, str]] = field(default_factory=list)
    at: int = 0
    edits: int = 0

    def __post_init__(self) -> None:
        self.steps.append((self.blueprint, stand(self.blueprint)))

    def edit(self, chance: random.Random) -> None:
        before = self.blueprint
        try:
            after = random_edit(chance, before)
        except EditRefused:
            return
        if after is before:
            return
        must_touch_only_what_changed(before, after)
        must_lead_back(before, after)
        del self.steps[self.at + 1 :]
        self.steps.append((after, stand(after)))
        self.edits += 1
        self.go(1)

    def go(self, step: int) -> None:
        """Undo or redo, and see whether all is as it was; each text still reads to the same."""
        self.at = max(0, min(self.at + step, len(self.steps) - 1))
        self.blueprint, was = self.steps[self.at]
        assert stand(self.blueprint) == was
        assert stand(as_read(self.blueprint)) == was


def as_read(blueprint: Blueprint) -> Blueprint:
    """The blueprint that its texts mean, read from nothing."""
    documents = [form_named(one.form).parse(one.text, one.file) for one in blueprint.documents]
    return read_blueprint(documents[0], opened=documents[1:])


def history(seed: int, length: int = 12) -> History:
    """A history of so many steps, each an edit, an undo or a redo."""
    chance = random.Random(seed)
    told = History(any_blueprint(chance))
    for _ in range(length):
        kind = chance.random()
        if kind < 0.6:
            told.edit(chance)
        else:
            told.go(-1 if kind < 0.85 else 1)
    return told


def must_lead_back(before: Blueprint, after: Blueprint) -> None:
    """Editing back, document by document, means what was meant before."""
    former = {one.file: one for one in before.documents}
    for document in after.documents:
        was = former.get(document.file)
        if was is not None and was is not document and not was.doubled:
            back = reconcile(document, was.values)
            assert back.values == was.values
            again = form_named(back.form).parse(back.text, back.file)
            assert again.values == was.values
            assert _order(again) == _order(was)


def _order(document: Document) -> list[str]:
    """The order of the SBs, which is meaning; that of other fields is none."""
    return [name for name in document.values if not name.startswith("_")]


# --- what an edit touches ------------------------------------------------------------------------


def must_touch_only_what_changed(before: Blueprint, after: Blueprint) -> None:
    former = {one.file: one for one in before.documents}
    for document in after.documents:
        was = former[document.file]
        if was is document:
            continue
        old, new = Lines(was), Lines(document)
        for path in _differences(was.values, document.values, ()):
            for between in (*old.neighbours(path, new), *new.neighbours(path, old)):
                old.allow(path[:-1], *between)
                new.allow(path[:-1], *between)
            old.allow_own(path)
            new.allow_own(path)
        assert not old.touched_beside(new), (was.text, document.text)
        assert not new.touched_beside(old), (was.text, document.text)


class Lines:
    """The lines of a document, and those that an edit may touch."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._lines = re.split("\r\n|\r|\n", document.text)
        self._allowed: set[str] = set()

    def members(self, path: tuple[str, ...]) -> tuple[Member, ...]:
        try:
            return tuple(sorted(self._document.members(path), key=lambda one: one.key_start))
        except KeyError:
            return ()

    def neighbours(
        self, path: tuple[str, ...], other: Lines
    ) -> Iterator[tuple[str | None, str | None]]:
        """Between which members, that stand in both documents, the one at ``path`` stands."""
        theirs = {member.key for member in other.members(path[:-1])} - {path[-1]}
        before: str | None = None
        found = False
        for member in self.members(path[:-1]):
            if member.key == path[-1]:
                found = True
            elif member.key in theirs:
                if found:
                    yield before, member.key
                    found = False
                before = member.key
        if found:
            yield before, None

    def allow(self, path: tuple[str, ...], before: str | None, after: str | None) -> None:
        """The lines between two members of the object at ``path``, or its ends."""
        text, inner = self._document.text, {one.key: one for one in self.members(path)}
        start, end = self._document.spans.root, len(text.rstrip())
        if path:
            member = self._document.member(path)
            start, end = member.value_start, member.value_end
            if self._document.form == "smsl" and path[1:] == ("HEADER",):
                # There are no braces of its own: its first line may be that of the SB's.
                start = self._document.member(path[:1]).value_start
        if before is not None:
            start = inner[before].value_end
        if after is not None:
            end = inner[after].key_start
        self._allow(min(start, end), max(start, end))

    def allow_own(self, path: tuple[str, ...]) -> None:
        """The lines of what stands at ``path``."""
        for member in self.members(path[:-1]):
            if member.key == path[-1]:
                self._allow(member.key_start, member.value_end)

    def _allow(self, start: int, end: int) -> None:
        text = self._document.text
        first = max(text.rfind("\n", 0, start), text.rfind("\r", 0, start)) + 1
        stop = re.compile("[\r\n]|$").search(text, end)
        assert stop is not None
        self._allowed.update(map(_bare, re.split("\r\n|\r|\n", text[first : stop.start()])))

    def touched_beside(self, other: Lines) -> list[str]:
        """Lines that are not in the other document, and were not to be touched."""
        mine, others = (Counter(map(_bare, one._lines)) for one in (self, other))
        return [line for line in mine - others if line and line not in self._allowed]


def _bare(line: str) -> str:
    """A line without separators."""
    return re.sub(r"[\s,\ufeff]", "", line)


def _differences(old: Json, new: Json, path: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """The paths of the members that differ: of those that are nowhere else the same."""
    both = [key for key in old if key in new]
    moved = both != [key for key in new if key in old]
    for key in dict.fromkeys((*old, *new)):
        inner = (*path, key)
        if key not in old or key not in new or moved:
            yield inner
        elif isinstance(old[key], dict) and isinstance(new[key], dict) and old[key] and new[key]:
            yield from _differences(old[key], new[key], inner)
        elif old[key] != new[key] or type(old[key]) is not type(new[key]):
            yield inner
