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

MOST = 500
"""The largest number of commits that are listed, the latest ones."""
_PATIENCE = 20.0
_SAFE = ("--no-pager", "--literal-pathspecs", "-c", "core.quotePath=false", "-c",
         "core.fsmonitor=false", "-c", "log.showSignature=false")  # fmt: skip
_BEGIN, _PART = "\x02", "\x1f"


@dataclass(frozen=True)
class Revision:
    """One commit that changed a file. ``name`` is the name of the file in this commit."""

    commit: str
    when: str
    author: str
    subject: str
    name: str

    @property
    def short(self) -> str:
        """The first nine characters of the commit, as git shows it."""
        return self.commit[:9]


def revisions(file: Path) -> tuple[Revision, ...]:
    """Return the commits that changed a file, the latest first. Renames are followed.

    ReadError if there is no git, no repository, or no commit with the file.
    """
    form = f"%x02%H{_PART}%aI{_PART}%an{_PART}%s"
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
    return _blob(file, f"{revision.commit}:{revision.name}", revision.short)


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
    parts = head.split(_PART, 3)
    name = names.strip("\n\0").partition("\0")[0]
    if len(parts) != 4 or not name:
        return None
    commit, when, author, subject = parts
    return Revision(commit, when, author, subject, name)


def _git(file: Path, *arguments: str) -> bytes:
    folder = file.parent
    quiet = {"GIT_TERMINAL_PROMPT": "0", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}
    kept = {k: v for k, v in os.environ.items() if k not in ("GIT_DIR", "GIT_WORK_TREE")}
    try:
        done = subprocess.run(
            ["git", *_SAFE, *arguments],
            cwd=folder,
            env=kept | quiet,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise ReadError(
            "git does not answer", advice="Try again, or compare with a file."
        ) from None
    except (OSError, ValueError) as error:
        if isinstance(error, FileNotFoundError) and folder.is_dir():
            raise ReadError(
                "git is not installed here", advice="Install git, or compare with a file."
            ) from None
        reason = getattr(error, "strerror", None) or error
        raise ReadError(
            f"{folder} cannot be looked at: {reason}", advice="Save the file first."
        ) from None
    if done.returncode:
        raise _refusal(file, done.stderr.decode("utf-8", "replace"))
    return done.stdout


def _refusal(file: Path, said: str) -> ReadError:
    words = said.strip().removeprefix("fatal: ").splitlines()
    if "not a git repository" in said:
        return ReadError(
            f"{file.name} is in no git repository", advice="Compare with a file instead."
        )
    if "does not have any commits" in said or "bad default revision" in said:
        return ReadError(f"no commit has {file.name} yet", advice="Commit it first.")
    return ReadError(f"git cannot tell: {words[0] if words else 'it gave no reason'}")
