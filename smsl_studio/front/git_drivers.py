"""Makes git compare and merge the blueprints of a repository by what they mean.

Two things are written: a block of lines in ``.gitattributes``, which goes along with the
repository, and the two commands in the repository's own configuration, which does not.
"""

from __future__ import annotations

import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import ReadError, SaveError
from smsl_studio.smsl.files import save_document

BEGIN, END = "# smsl-studio begin", "# smsl-studio end"
PATTERNS = ("*.smsl", "*.json", "*.yaml", "*.yml")
DRIVERS = {
    "diff.smsl.command": "smsl-studio diff --",
    "merge.smsl.name": "merge of blueprints by what they mean",
    "merge.smsl.driver": "smsl-studio merge %O %A %B --name=%P",
}
FORMER = {"merge.smsl.driver": "smsl-studio merge %O %A %B --name %P"}
"""The values that earlier versions of Studio wrote. They are removed too."""
_PATIENCE = 20.0


@dataclass(frozen=True)
class GitSetup:
    """What was written or taken back: the file of attributes, and the keys of the
    configuration."""

    attributes: Path
    keys: tuple[str, ...]
    changed: bool


def git_setup(folder: str | os.PathLike[str] = ".", undo: bool = False) -> GitSetup:
    """Let git call smsl-studio for blueprints in the repository of a folder, or take that back.

    What others wrote into ``.gitattributes`` stays as it is. A second call changes nothing.
    ReadError if the folder is in no repository. SaveError if a file cannot be written.

    >>> git_setup("nowhere")
    Traceback (most recent call last):
    smsl_studio.errors.ReadError: git cannot be asked about nowhere: No such file or directory
    """
    top = Path(_git(Path(folder), "rev-parse", "--show-toplevel").strip())
    attributes = top / ".gitattributes"
    _must_be_ordinary(attributes)
    try:
        before = attributes.read_bytes() if attributes.exists() else b""
        after = _without(before) if undo else _with_block(before)
        if after != before:
            _write(attributes, after)
    except OSError as error:
        raise SaveError(
            f"{attributes} was not written: {error.strerror or error}",
            advice="Check the right to write it.",
        ) from error
    change = _take_back if undo else _configure
    keys = tuple(key for key, value in DRIVERS.items() if change(top, key, value))
    return GitSetup(attributes, keys, after != before)


def _configure(top: Path, key: str, value: str) -> bool:
    """Set a key of git's configuration to a value. Return whether this changes anything.

    A key may have several values, and git uses the last one. So values that others wrote are kept
    before it.
    """
    if _values(top, key)[-1:] == [value]:
        return False
    _take_back(top, key, value)
    _git(top, "config", "--local", "--add", key, value)
    return True


def _take_back(top: Path, key: str, value: str) -> bool:
    """Remove our value of a key, also that of an earlier version. Return whether there was one.

    Values that others wrote stay.
    """
    ours = {value, FORMER.get(key, value)} & {*_values(top, key)}
    for one in sorted(ours):
        _git(top, "config", "--local", "--unset-all", key, f"^{_UNCOMMON.sub(_escaped, one)}$")
    return bool(ours)


def _values(top: Path, key: str) -> list[str]:
    """Return all values of a key in the configuration of a repository, in order."""
    found = _git(top, "config", "--local", "--null", "--get-all", key, nothing=1)
    return found.split("\0")[:-1]


def _escaped(found: re.Match[str]) -> str:
    """Return a character escaped for git's patterns, in which it may have a meaning."""
    return f"[{found[0]}]"


_UNCOMMON = re.compile(r"[^\w %=-]")


def _must_be_ordinary(attributes: Path) -> None:
    """Raise SaveError if the file of attributes is a link, a pipe or a folder.

    A link could lead out of the repository. Git itself reads no attributes through a link.
    """
    ordinary = not attributes.is_symlink() and attributes.is_file()
    if os.path.lexists(attributes) and not ordinary:
        raise SaveError(
            f"{attributes} is no ordinary file, so nothing was written",
            advice="Put an ordinary file there, or remove it.",
        )


def _write(attributes: Path, text: bytes) -> None:
    if text:
        save_document(text, attributes)
    else:
        attributes.unlink()


def _with_block(text: bytes) -> bytes:
    """Return the attributes with the block at the end. Line ends are those of the text."""
    end = b"\r\n" if b"\r\n" in text else b"\n"
    lines = [BEGIN, *_lines(), END]
    block = b"".join(line.encode() + end for line in lines)
    if block in text:
        return text
    rest = _without(text)
    return rest + (end if rest and not rest.endswith(b"\n") else b"") + block


def _without(text: bytes) -> bytes:
    """Return the attributes without the lines that Studio wrote.

    Lines of others inside our block stay, even if the end of the block is missing.
    """
    ours = {line.encode() for line in (BEGIN, END, *_lines())}
    kept, inside = [], False
    for line in text.splitlines(keepends=True):
        said = line.strip()
        inside = inside or said == BEGIN.encode()
        if not (inside and said in ours):
            kept.append(line)
        inside = inside and said != END.encode()
    return b"".join(kept)


def _lines() -> list[str]:
    return [f"{pattern} diff=smsl merge=smsl" for pattern in PATTERNS]


def _git(folder: Path, *arguments: str, nothing: int = 0) -> str:
    """Return the output of git. The exit status ``nothing`` means an empty output."""
    kept = {k: v for k, v in os.environ.items() if k not in ("GIT_DIR", "GIT_WORK_TREE")}
    try:
        done = subprocess.run(
            ["git", *arguments], cwd=folder, env=kept | {"LC_ALL": "C"}, capture_output=True,
            stdin=subprocess.DEVNULL, text=True, timeout=_PATIENCE, check=False,
        )  # fmt: skip
    except (OSError, ValueError, subprocess.TimeoutExpired) as error:
        raise ReadError(
            f"git cannot be asked about {folder}: {getattr(error, 'strerror', None) or error}",
            advice="Install git, and name a folder that exists.",
        ) from error
    if done.returncode not in (0, nothing):
        words = done.stderr.strip().removeprefix("fatal: ").splitlines()
        raise ReadError(
            f"{folder} is in no git repository" if "not a git repository" in done.stderr
            else f"git refuses: {words[0] if words else 'it gave no reason'}",
            advice="Make one with: git init",
        )  # fmt: skip
    return done.stdout
