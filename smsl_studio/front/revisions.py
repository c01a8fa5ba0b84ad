"""The versions of a file in git: the commits that changed it, and its content in each.

This module runs git in a child process that cannot prompt. Every failure becomes a ReadError with
one sentence.
"""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.stop import heed

MOST = 500
"""The largest number of commits that are listed, the latest ones."""
_PATIENCE, _GLANCE = 20.0, 0.1
"""Seconds until git is ended, and between two looks whether it is still wanted."""
_SAFE = ("--no-pager", "--literal-pathspecs", "-c", "core.quotePath=false", "-c",
         "core.fsmonitor=false", "-c", "log.showSignature=false")  # fmt: skip
_BEGIN, _PART = "\x02", "\x1f"


@dataclass(frozen=True)
class Revision:
    """One commit that changed a file. ``name`` is the name of the file in this commit. ``parents``
    are the commits that it follows, several for a merge."""

    commit: str
    when: str
    author: str
    subject: str
    name: str
    parents: tuple[str, ...] = ()

    @property
    def short(self) -> str:
        """The first nine characters of the commit, as git shows it."""
        return self.commit[:9]


def revisions(file: Path) -> tuple[Revision, ...]:
    """Return the commits that changed a file, the latest first. Renames are followed.

    ReadError if there is no git, no repository, or no commit with the file.
    """
    form = f"%x02%H{_PART}%aI{_PART}%an{_PART}%P{_PART}%s"
    told = _git(
        file, "log", "--follow", "-z", "--name-only", f"--max-count={MOST}", f"--format={form}",
        "--", file.name,
    )  # fmt: skip
    found = tuple(
        one for one in map(_revision, told.decode("utf-8", "replace").split(_BEGIN)) if one
    )
    if not found:
        raise ReadError(
            f"no commit has {file.name} yet", advice="Commit it first, or compare with a file."
        )
    return found


def bytes_at(file: Path, revision: Revision) -> bytes:
    """Return the content of a file at a revision. ReadError if the file is missing there or too
    large."""
    return bytes_of(file, revision.commit, revision.name)


def bytes_of(file: Path, commit: str, name: str) -> bytes:
    """Return the content of a file in a commit under a name. ReadError if it is missing there or
    too large. A name that begins with ``./`` is below the folder of the file."""
    return _blob(file, f"{commit}:{name}", commit[:9])


def is_shallow(file: Path) -> bool:
    """Return whether the repository of a file has only the latest commits of its history."""
    return _git(file, "rev-parse", "--is-shallow-repository").strip() == b"true"


def unmerged_bytes(file: Path) -> tuple[bytes | None, bytes | None, bytes | None]:
    """Return base, ours and theirs of a file as git's index keeps them while a merge has not ended;
    None for a version that does not exist. All are None if no merge of the file is open.

    ReadError if there is no git, no repository, or a version is too large.
    """
    told = _git(file, "ls-files", "--unmerged", "-z", "--", file.name)
    found: dict[str, bytes] = {}
    for entry in told.decode("utf-8", "replace").split("\0"):
        head, _, _name = entry.partition("\t")
        parts = head.split(" ")
        if len(parts) == 3:
            found[parts[2]] = _blob(file, parts[1], "the index of git")
    return found.get("1"), found.get("2"), found.get("3")


def merging_commits(file: Path) -> dict[str, tuple[str, str, str]]:
    """Return the commits of a merge that has not ended: for ``ours``, ``theirs`` and ``base`` the
    author, the day (2026-11-20) and the commit that last changed the file there. A version without
    such a commit is left out, as theirs is while git picks a commit.
    """
    found: dict[str, tuple[str, str, str]] = {}
    form = _PART.join(("%an", "%as", "%H"))
    base = _told(file, "merge-base", "HEAD", "MERGE_HEAD")
    for side, start in (("ours", "HEAD"), ("theirs", "MERGE_HEAD"), ("base", base)):
        told = _told(file, "log", "-1", f"--format={form}", start, "--", file.name) if start else ""
        parts = told.split(_PART)
        if len(parts) == 3:
            found[side] = parts[0], parts[1], parts[2]
    return found


def _told(file: Path, *arguments: str) -> str:
    """Return what git says, an empty text if it cannot."""
    try:
        return _git(file, *arguments).decode("utf-8", "replace").strip()
    except ReadError:
        return ""


def _blob(file: Path, thing: str, where: str) -> bytes:
    """Return the content of an object of git. ReadError if it is too large."""
    size = _git(file, "cat-file", "-s", thing)
    if not size.strip().isdigit() or int(size) > LARGEST_FILE:
        raise ReadError(
            f"{file.name} is larger than {LARGEST_FILE >> 20} MB in {where}",
            advice="Compare with another commit.",
        )
    return _git(file, "cat-file", "blob", thing)


def _revision(text: str) -> Revision | None:
    head, _, names = text.partition("\0")
    parts = head.split(_PART, 4)
    name = names.strip("\n\0").partition("\0")[0]
    if len(parts) != 5 or not name:
        return None
    commit, when, author, parents, subject = parts
    return Revision(commit, when, author, subject, name, tuple(parents.split()))


def _git(file: Path, *arguments: str) -> bytes:
    folder = file.parent
    quiet = {"GIT_TERMINAL_PROMPT": "0", "GIT_OPTIONAL_LOCKS": "0", "GIT_NO_LAZY_FETCH": "1",
             "LC_ALL": "C"}  # fmt: skip
    kept = {k: v for k, v in os.environ.items() if k not in ("GIT_DIR", "GIT_WORK_TREE")}
    try:
        process = subprocess.Popen(
            ["git", *_SAFE, *arguments],
            cwd=folder,
            env=kept | quiet,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
    except (OSError, ValueError) as error:
        if isinstance(error, FileNotFoundError) and folder.is_dir():
            raise ReadError(
                "git is not installed here", advice="Install git, or compare with a file."
            ) from None
        reason = getattr(error, "strerror", None) or error
        raise ReadError(
            f"{folder} cannot be looked at: {reason}", advice="Save the file first."
        ) from None
    out, said = _answer(process)
    if process.returncode:
        raise _refusal(file, said.decode("utf-8", "replace"))
    return out


def _answer(process: subprocess.Popen[bytes]) -> tuple[bytes, bytes]:
    """Return what git writes. It is ended if a stop calls the work off, or after ``_PATIENCE``."""
    with process:
        try:
            for _ in range(round(_PATIENCE / _GLANCE)):
                heed()
                try:
                    return process.communicate(timeout=_GLANCE)
                except subprocess.TimeoutExpired:
                    continue
        finally:
            if process.returncode is None:
                process.kill()
    raise ReadError("git does not answer", advice="Try again, or compare with a file.")


def _refusal(file: Path, said: str) -> ReadError:
    words = said.strip().removeprefix("fatal: ").splitlines()
    if "not a git repository" in said:
        return ReadError(
            f"{file.name} is in no git repository", advice="Compare with a file instead."
        )
    if "does not have any commits" in said or "bad default revision" in said:
        return ReadError(f"no commit has {file.name} yet", advice="Commit it first.")
    return ReadError(f"git cannot tell: {words[0] if words else 'it gave no reason'}")
