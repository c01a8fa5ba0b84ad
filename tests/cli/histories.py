"""Random histories of a blueprint in git: commits, branches, merges and rebases.

git does every merge with the driver of ``git-setup``. Beside it stands the merge of the three
versions in this process, which is held against the oracle of ``tests/blueprint/merge``. Both must
give the same. A conflict is closed as a person would who keeps his own version.
"""

from __future__ import annotations

from pathlib import Path
from random import Random

from smsl_studio.blueprint.editing.draft import Draft
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json
from tests.blueprint.merge.random_merges import check_against_the_oracle
from tests.blueprint.merge.sides import Thing, drawn, edited, things
from tests.cli.repository import Repository

FILE = "plan.json"
STEPS = 20


class History(Repository):
    """One random history. ``merges`` and ``conflicts`` count what has happened in it.

    Histories of odd numbers rename states too; the oracle knows no renames, so there only git and
    the merge in this process are compared.
    """

    def __init__(self, folder: Path, number: int) -> None:
        super().__init__(folder)
        self._chance = Random(number)
        self._renames = number % 2 == 1
        self.merges = self.conflicts = 0
        self._write(drawn(self._chance))
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "the first version")
        for name in ("one", "two"):
            self.git("branch", name)

    def grow(self) -> None:
        """Take some random steps, then merge all branches into ``main``."""
        for _ in range(STEPS):
            self.git("checkout", "-q", self._chance.choice(("main", "one", "two")))
            self._commit()
            kind = self._chance.randrange(3)
            other = self._chance.choice([name for name in ("one", "two") if name != self._branch()])
            if kind == 0:
                self._merge(other)
            elif kind == 1 and self._branch() != "main":
                self._rebase()
        self.git("checkout", "-q", "main")
        self._merge("one")
        self._merge("two")

    def _branch(self) -> str:
        return self.git("branch", "--show-current").strip()

    def _commit(self) -> None:
        before = self._version("HEAD")
        self._write(edited(before, self._chance, self._chance.randint(1, 4), self._renames))
        self.git("commit", "-q", "--allow-empty", "-a", "-m", "a step")

    def _merge(self, other: str) -> None:
        bases = self.git("merge-base", "--all", "HEAD", other).split()
        if self.git("rev-parse", other).strip() in bases:
            return
        ours, theirs = self._version("HEAD"), self._version(other)
        done = self._try("merge", "-q", "--no-ff", "-m", "joined", other)
        if len(bases) == 1:
            wanted = self._expected(self._version(bases[0]), ours, theirs)
            assert things(self._read()) == things(wanted), f"merge of {other}"
        self._keep_what_both_have(ours, theirs)
        if not done:
            self._close()
            self.git("commit", "-q", "-a", "-m", "joined by hand")

    def _rebase(self) -> None:
        """Rebase the branch on main: every commit is a merge with its parent as the base."""
        commits = self.git("rev-list", "--reverse", "--no-merges", "--topo-order", "main..HEAD")
        wanted = self._version("main")
        for commit in commits.split():
            wanted = self._expected(self._version(f"{commit}^"), wanted, self._version(commit))
        done = self._try("rebase", "-q", "--reapply-cherry-picks", "main")
        while not done:
            self._close()
            self.git("add", "-A")
            done = self._try("-c", "core.editor=true", "rebase", "--continue")
        assert things(self._read()) == things(wanted), "rebase"

    def _expected(self, base: Blueprint, ours: Blueprint, theirs: Blueprint) -> Blueprint:
        self.merges += 1
        if self._renames:
            done = merge(base, ours, theirs)
        else:
            done = check_against_the_oracle(base, ours, theirs)
        self.conflicts += len(done.conflicts)
        return _closed(done.blueprint)

    def _keep_what_both_have(self, ours: Blueprint, theirs: Blueprint) -> None:
        """States and operations that both sides have are there afterwards, with several bases of
        the merge too."""
        kinds = ("state", "target")
        here, there, after = (
            {thing for thing in things(one) if thing[0] in kinds}
            for one in (ours, theirs, self._read())
        )
        missing: set[Thing] = (here & there) - after
        assert not missing, missing

    def _close(self) -> None:
        self._write(_closed(self._read()))

    def _try(self, *arguments: str) -> bool:
        """Call git. False if a conflict is open, which must stand in a readable file."""
        if self.attempt(*arguments) == 0:
            assert "_conflicts" not in self._read().document.values
            return True
        assert self._read().document.values["_conflicts"]
        return False

    def _version(self, commit: str) -> Blueprint:
        return read_blueprint(parse_json(self.git("show", f"{commit}:{FILE}"), FILE))

    def _read(self) -> Blueprint:
        return read_blueprint(parse_json((self.folder / FILE).read_text(), FILE))

    def _write(self, blueprint: Blueprint) -> None:
        (self.folder / FILE).write_text(blueprint.document.text)


def _closed(blueprint: Blueprint) -> Blueprint:
    """The blueprint after a person has kept his own version of every conflict."""
    if "_conflicts" not in blueprint.document.values:
        return blueprint
    draft = Draft(blueprint)
    draft.file().pop("_conflicts")
    return draft.done()
