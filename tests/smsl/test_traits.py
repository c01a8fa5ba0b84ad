"""What a saved file keeps besides its text (mode, owner, ACL).

What it would lose is told before.
"""

from __future__ import annotations

import errno
import grp
import os
import pickle
import pwd
import tempfile
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest

from smsl_studio.smsl import traits
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.together import save_together
from smsl_studio.smsl.traits import ACL, losses, traits_of

Came = TypeVar("Came")
ROOT = os.geteuid() == 0
NOBODY, OWNER, GROUP = 65534, 12345, 54321
LIST = b"\x02\x00\x00\x00" + b"".join(
    tag.to_bytes(2, "little") + perm.to_bytes(2, "little") + who.to_bytes(4, "little")
    for tag, perm, who in ((1, 6, 2**32 - 1), (2, 6, OWNER), (4, 4, 2**32 - 1),
                           (16, 6, 2**32 - 1), (32, 0, 2**32 - 1))
)  # fmt: skip
"""u::rw- u:12345:rw- g::r-- m::rw- o::---, as the kernel writes it."""


@pytest.fixture
def folder() -> Iterator[Path]:
    """A folder into which everybody may write."""
    with tempfile.TemporaryDirectory() as name:
        Path(name).chmod(0o777)
        yield Path(name)


@pytest.fixture
def target(folder: Path) -> Path:
    path = folder / "x.json"
    path.write_text("old", "utf-8")
    return path


def as_nobody(work: Callable[[], Came]) -> Came:
    """What ``work`` returns in a process that may no more than any user."""
    read, write = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads of the test runner
        pid = os.fork()
    if pid == 0:
        try:
            os.setgroups([])
            os.setresgid(NOBODY, NOBODY, NOBODY)
            os.setresuid(NOBODY, NOBODY, NOBODY)
            os.write(write, pickle.dumps(work()))
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as stream:
        raw = stream.read()
    os.waitpid(pid, 0)
    return pickle.loads(raw)  # type: ignore[no-any-return]


def saved_one(target: Path) -> None:
    save_document("new", target)


def saved_two(target: Path) -> None:
    save_together([("new", target), ("other", target.with_name("y.json"))])


SAVES = pytest.mark.parametrize("save", [saved_one, saved_two])


def has(target: Path) -> tuple[int, int, int]:
    found = traits_of(target)
    assert found is not None
    return found.owner, found.group, found.mode


@SAVES
def test_ones_own_file_keeps_its_rights(target: Path, save: Callable[[Path], None]) -> None:
    target.chmod(0o640)
    assert losses(target) == ()
    save(target)
    assert (target.read_text(), has(target)[2]) == ("new", 0o640)
    assert sorted(one.suffix for one in target.parent.iterdir()) in ([".json"], [".json"] * 2)


if ROOT:

    @SAVES
    @pytest.mark.parametrize("mode", [0o640, 0o4755, 0o2664])
    def test_root_keeps_owner_group_and_rights(
        target: Path, save: Callable[[Path], None], mode: int
    ) -> None:
        os.chown(target, OWNER, GROUP)
        target.chmod(mode)
        assert losses(target) == ()
        save(target)
        assert (target.read_text(), has(target)) == ("new", (OWNER, GROUP, mode))

    @pytest.mark.parametrize(
        ("before", "after"),
        [(0o666, 0o666), (0o676, 0o666), (0o4606, 0o606), (0o2676, 0o666), (0o6777, 0o777)],
    )
    def test_a_user_says_what_is_lost_and_gives_nobody_a_right(
        target: Path, before: int, after: int
    ) -> None:
        os.chown(target, OWNER, GROUP)
        target.chmod(before)
        told = as_nobody(lambda: losses(target))
        assert told == (f"its group, {GROUP}", f"its owner, {OWNER}")
        assert (target.read_text(), has(target)) == ("old", (OWNER, GROUP, before))
        as_nobody(lambda: saved_one(target))
        assert (target.read_text(), has(target)) == ("new", (NOBODY, NOBODY, after))

    def test_a_user_keeps_a_group_that_is_his(target: Path) -> None:
        os.chown(target, NOBODY, NOBODY)
        target.chmod(0o664)
        assert as_nobody(lambda: losses(target)) == ()
        as_nobody(lambda: saved_one(target))
        assert has(target) == (NOBODY, NOBODY, 0o664)

    def test_names_of_owner_and_group_are_told_where_there_are_some(target: Path) -> None:
        os.chown(target, 0, 0)
        target.chmod(0o666)
        names = grp.getgrgid(0).gr_name, pwd.getpwuid(0).pw_name
        told = as_nobody(lambda: losses(target))
        assert told == (f"its group, {names[0]}", f"its owner, {names[1]}")


def node(file: int | Path) -> int:
    return os.stat(file).st_ino  # noqa: PTH116 -- takes numbers


class Attributes:
    """Extended attributes of a disk of which it is known what it keeps, by the file's inode."""

    def __init__(self, patch: pytest.MonkeyPatch, refused: tuple[str, ...] = ()) -> None:
        self.of: dict[int, dict[str, bytes]] = {}
        self._refused = refused
        for name in ("listxattr", "getxattr", "setxattr"):
            patch.setattr(os, name, getattr(self, name))

    def listxattr(self, file: int | Path) -> list[str]:
        return list(self.of.get(node(file), ()))

    def getxattr(self, file: int | Path, name: str) -> bytes:
        return self.of[node(file)][name]

    def setxattr(self, file: int | Path, name: str, value: bytes) -> None:
        if name in self._refused:
            raise OSError(errno.ENOTSUP, "not supported")
        self.of.setdefault(node(file), {})[name] = value


@SAVES
def test_attributes_and_lists_are_kept(
    target: Path, save: Callable[[Path], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    disk = Attributes(monkeypatch)
    mine = {"user.note": b"seen", ACL: LIST}
    disk.of[node(target)] = dict(mine)
    target.chmod(0o660)
    assert losses(target) == ()
    save(target)
    assert disk.of[node(target)] == mine
    assert has(target)[2] == 0o660


def test_a_list_that_is_lost_gives_the_group_no_more_than_it_had(
    target: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a list the middle bits of the mode are its mask, and not the group's rights."""
    disk = Attributes(monkeypatch, refused=(ACL, "user.note"))
    disk.of[node(target)] = {"user.note": b"seen", ACL: LIST}
    target.chmod(0o660)
    assert losses(target) == ("its attribute user.note", "its access control list")
    saved_one(target)
    assert has(target)[2] == 0o640


def test_further_names_are_told(target: Path) -> None:
    os.link(target, target.with_name("second.json"))
    assert losses(target) == ("another name (hard links), which would keep the old text",)
    os.link(target, target.with_name("third.json"))
    assert losses(target) == ("2 other names (hard links), which would keep the old text",)
    saved_one(target)
    assert (target.read_text(), target.with_name("third.json").read_text()) == ("new", "old")


def test_a_link_keeps_pointing_and_its_file_keeps_its_rights(target: Path) -> None:
    link = target.with_name("link.json")
    link.symlink_to(target)
    target.chmod(0o604)
    saved_one(link)
    assert link.is_symlink()
    assert (target.read_text(), has(target)[2]) == ("new", 0o604)


def test_what_cannot_be_tried_and_what_is_not_there(target: Path) -> None:
    assert losses(target.with_name("none.json")) == ()
    assert traits.traits_of(target.with_name("none.json")) is None
    with pytest.raises(OSError, match="no ordinary file"):
        losses(target.parent)
