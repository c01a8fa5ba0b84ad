"""What stands on the disk, file by file, as far as the window has seen it."""

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
    """A file as it is now, compared with what the window has seen of it.

    ``text`` is what stands there, None where nothing is there (``gone``) or it is no text.
    ``seen`` is what a save is to replace, None where that cannot be read.
    """

    file: str
    text: str | None
    changed: bool
    gone: bool = False
    seen: Seen | None = None


class OnDisk:
    """Remembers every text that was read or saved, by the name of its document."""

    def __init__(self) -> None:
        self._seen: dict[str, str | None] = {}
        self._digests: dict[str, str] = {}
        self._last: dict[str, str] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self._seen))

    def __contains__(self, file: str) -> bool:
        return file in self._seen

    def forget(self) -> None:
        """Another blueprint was opened."""
        self._seen.clear()
        self._digests.clear()
        self._last.clear()

    def saw(self, file: str, text: str | None) -> None:
        """This text stands in the file, or nothing does."""
        before = self._seen.get(file)
        if text is None and before is not None:
            self._last[file] = before
        self._seen[file] = text
        self._digests.pop(file, None)

    def saw_if_new(self, texts: Mapping[str, str]) -> None:
        """Files that nobody knew were read a moment ago, so this is what stands in them."""
        for file, text in texts.items():
            self._seen.setdefault(file, text)

    def text(self, file: str) -> str | None:
        """What stands in a file; None where nothing does, or nothing is known."""
        return self._seen.get(file)

    def digest(self, file: str) -> str:
        """The SHA-256 of what stands in a file, worked out once; empty where nothing does."""
        text = self._seen.get(file)
        if text is None:
            return ""
        if file not in self._digests:
            self._digests[file] = sha256(text.encode("utf-8")).hexdigest()
        return self._digests[file]

    def differing(self, texts: Mapping[str, str]) -> tuple[str, ...]:
        """The files in which another text stands than these."""
        return tuple(file for file, text in texts.items() if self._seen.get(file) != text)

    def is_nowhere(self, file: str, text: str) -> bool:
        """Whether a text stands nowhere else: not in its file, nor did it when that was deleted."""
        seen = self._seen.get(file)
        return text != (seen if seen is not None else self._last.get(file))

    def look(self, file: str) -> DiskLook:
        """Look at a file again."""
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
