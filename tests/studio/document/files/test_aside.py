"""Imports that come and go by typing, undo and redo: no text of an imported file is ever lost."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import empty_blueprint
from smsl_studio.studio.document.files.questions import Answer, Interrupted
from smsl_studio.studio.document.session import Session

INNER = '{"SB2": {"A": {}}}'
IMPORT = '"_imports": ["inner.json"], '
OUTER = '{%s"SB1": {"A": {}}}'


class Nobody:
    """Is asked nothing: nobody else writes these files."""

    def file_to_open(self, folder: Path) -> Path | None:
        raise AssertionError(folder)

    def file_to_save(self, suggested: Path) -> Path | None:
        raise AssertionError(suggested)

    def unsaved(self, said: str) -> Answer:
        raise AssertionError(said)

    def interrupted(self, names: str, when: str) -> Interrupted:
        raise AssertionError(names)

    def may_overwrite(self, names: str) -> bool:
        raise AssertionError(names)

    def may_leave_comments(self, name: str, form: str) -> bool:
        raise AssertionError(name)

    def may_drop(self, said: str) -> bool:
        raise AssertionError(said)

    def may_lose(self, said: str) -> bool:
        raise AssertionError(said)

    def may_save_broken(self, name: str, faults: str) -> bool:
        return True


class Work:
    """Somebody who edits two files and takes the import of one of them out and in."""

    def __init__(self, folder: Path, chance: random.Random) -> None:
        self.chance, self.inner, self.outer = chance, folder / "inner.json", folder / "outer.json"
        self.first = OUTER % chance.choice(["", IMPORT])
        self.inner.write_text(INNER)
        self.outer.write_text(self.first)
        self.session = Session(empty_blueprint())
        self.files = Files(self.session, Settings(folder / "home"), Nobody())
        assert self.files.open(self.outer)
        self.text = INNER
        """What the imported file holds for who works here, whether it is shown or not."""

    def step(self, number: int) -> None:
        session = self.session
        what = self.chance.choice(["draw", "draw", "import", "import", "undo", "undo", "redo",
                                   "save", "break"])  # fmt: skip
        if what == "draw":
            branch = self.chance.choice(list(session.blueprint.branches))
            session.edit("Add", lambda bp: editing.add_state(bp, branch, f"S{number}"))
        elif what == "import" and session.broken is None:
            text = session.texts[str(self.outer)]
            without = text.replace(IMPORT, "")
            session.write(
                "Type", text.replace("{", "{" + IMPORT, 1) if text == without else without
            )
        elif what == "undo":
            session.history.undo()
        elif what == "redo":
            session.history.redo()
        elif what == "save":
            assert self.files.save()
        elif what == "break":
            file = self.chance.choice(list(session.texts))
            session.write("Type", session.texts[file][:-1], file)
        self.look(what)

    def look(self, what: str) -> None:
        file, before = str(self.inner), self.text
        if file in self.session.texts:
            self.text = self.session.texts[file]
        elif file in self.session.aside:
            self.text = self.session.aside[file].text
        if what in ("import", "save"):
            assert self.text == before, "neither importing nor saving changes a text"
        if self.text != self.inner.read_text():
            assert self.files.texts[file] == self.text
            assert file in self.files.unsaved


@pytest.mark.parametrize("part", range(4))
def test_whatever_is_undone_or_imported_no_text_is_lost(
    qapp: object, tmp_path: Path, part: int
) -> None:
    for seed in range(part * 30, part * 30 + 15):
        folder = tmp_path / str(seed)
        folder.mkdir()
        work = Work(folder, random.Random(seed))
        for number in range(25):
            work.step(number)
        while work.session.history.canUndo():
            work.session.history.undo()
        assert work.files.save()
        assert (work.outer.read_text(), work.inner.read_text()) == (work.first, INNER)
