"""What the window knows of each file's text on the disk."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from smsl_studio.errors import ReadError
from smsl_studio.smsl.files import read_content, text_of
from smsl_studio.smsl.inputs import NOTHING, Seen


@dataclass(frozen=True)
class DiskLook:
    """A file on the disk as it is now, and whether it ``changed`` since the window last read or
    wrote it.

    ``text`` is its text. It is None if there is no file (``gone``) or it cannot be read as text.
    ``seen`` identifies the content that a save will replace. It is None if the file cannot be read.
    """

    file: str
    text: str | None
    changed: bool
    gone: bool = False
    seen: Seen | None = None


class OnDisk:
    """The text that each file had when the window last read or wrote it, by document name."""

    def __init__(self) -> None:
        self._seen: dict[str, str | None] = {}
        self._digests: dict[str, str] = {}
        self._last: dict[str, str] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self._seen))

    def __contains__(self, file: str) -> bool:
        return file in self._seen

    def forget(self) -> None:
        """Forget all files, because another blueprint was opened."""
        self._seen.clear()
        self._digests.clear()
        self._last.clear()

    def saw(self, file: str, text: str | None) -> None:
        """Remember that the file has this text; None means that there is no file."""
        before = self._seen.get(file)
        if text is None and before is not None:
            self._last[file] = before
        self._seen[file] = text
        self._digests.pop(file, None)

    def saw_if_new(self, texts: Mapping[str, str]) -> None:
        """Remember these texts for files that are not known yet, because they were just read."""
        for file, text in texts.items():
            self._seen.setdefault(file, text)

    def text(self, file: str) -> str | None:
        """The known text of a file; None if there is no file or it is not known."""
        return self._seen.get(file)

    def digest(self, file: str) -> str:
        """The SHA-256 of the known text, computed once; empty if there is none."""
        text = self._seen.get(file)
        if text is None:
            return ""
        if file not in self._digests:
            self._digests[file] = sha256(text.encode("utf-8")).hexdigest()
        return self._digests[file]

    def differing(self, texts: Mapping[str, str]) -> tuple[str, ...]:
        """The files whose known text differs from the one given here."""
        return tuple(file for file, text in texts.items() if self._seen.get(file) != text)

    def is_nowhere(self, file: str, text: str) -> bool:
        """Whether this text would be lost: it is neither in its file, nor was it there when the
        file was deleted."""
        seen = self._seen.get(file)
        return text != (seen if seen is not None else self._last.get(file))

    def look(self, file: str) -> DiskLook:
        """Read a file again and compare it with what is known."""
        now: str | None = None
        seen: Seen | None = None
        with suppress(ReadError):
            content = read_content(file)
            seen = content.seen
            now = text_of(content, file)
        before = self._seen.get(file)
        gone = now is None and not Path(file).is_file()
        changed = now != before if now is not None or gone else True
        return DiskLook(file, now, changed, gone, NOTHING if gone else seen)
