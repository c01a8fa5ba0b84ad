"""The content of a journal: the texts of a window that are not saved, and where they belong.

The file has a line with the format, a line of JSON, and the bytes of the texts. The JSON has the
length and SHA-256 of each text. The reader checks everything, because a journal may be cut, damaged
or made by somebody else.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

from smsl_studio.errors import ReadError

MAGIC = b"SMSL Studio journal 1\n"
HEAD, TEXTS, NAME = 4 << 20, 10_000, 4096
"""The largest head (bytes), number of texts, and length of a name (characters) that are read."""


@dataclass(frozen=True)
class KeptText:
    """One unsaved text.

    ``saved`` is the SHA-256 of the file's text on the disk at that time, empty for none.
    """

    file: str
    text: str
    saved: str = ""


@dataclass(frozen=True)
class JournalEntry:
    """The unsaved work of one window.

    ``path`` is the place of its blueprint, empty if it was never saved. ``file`` is the name of the
    blueprint's own text among ``texts``. ``changes`` is the number of changes in the window.
    ``when`` is the local time of writing.
    """

    name: str
    path: str
    file: str
    when: str
    changes: int
    texts: tuple[KeptText, ...]


def encode(entry: JournalEntry) -> bytes:
    """The bytes of a journal file."""
    bodies = [kept.text.encode("utf-8", "surrogatepass") for kept in entry.texts]
    head = {
        "name": entry.name,
        "path": entry.path,
        "file": entry.file,
        "when": entry.when,
        "changes": entry.changes,
        "texts": [
            {
                "file": kept.file,
                "saved": kept.saved,
                "bytes": len(body),
                "sha256": sha256(body).hexdigest(),
            }
            for kept, body in zip(entry.texts, bodies, strict=True)
        ],
    }
    return b"".join([MAGIC, json.dumps(head).encode("ascii"), b"\n", *bodies])


def decode(raw: bytes) -> JournalEntry:
    """The entry in the bytes of a journal file.

    Raises ReadError if they are not complete and valid.
    """
    if not raw.startswith(MAGIC):
        raise _no("it does not begin like one")
    end = raw.find(b"\n", len(MAGIC), len(MAGIC) + HEAD)
    if end < 0:
        raise _no("its head is cut off")
    head = _head(raw[len(MAGIC) : end])
    listed = head.get("texts")
    if not isinstance(listed, list) or not 0 < len(listed) <= TEXTS:
        raise _no("it lists no texts")
    changes = head.get("changes")
    if type(changes) is not int or changes < 0:
        raise _no("the number of its changes is missing")
    texts, rest = [], memoryview(raw)[end + 1 :]
    for item in listed:
        if not isinstance(item, dict):
            raise _no("one of its texts is not described")
        kept, rest = _kept(item, rest)
        texts.append(kept)
    if len(rest):
        raise _no("it is longer than its head says")
    words = {key: _word(head, key) for key in ("name", "path", "file", "when")}
    return JournalEntry(**words, changes=changes, texts=tuple(texts))


def _head(line: bytes) -> dict[str, Any]:
    try:
        head = json.loads(line)
    except (ValueError, RecursionError):
        raise _no("its head cannot be read") from None
    if not isinstance(head, dict):
        raise _no("its head is no object")
    return head


def _kept(item: dict[str, Any], rest: memoryview) -> tuple[KeptText, memoryview]:
    length = item.get("bytes")
    if type(length) is not int or not 0 <= length <= len(rest):
        raise _no("one of its texts is cut off")
    body = bytes(rest[:length])
    if sha256(body).hexdigest() != item.get("sha256"):
        raise _no("one of its texts was damaged")
    try:
        text = body.decode("utf-8", "surrogatepass")
    except UnicodeDecodeError:
        raise _no("one of its texts is no text") from None
    kept = KeptText(_word(item, "file"), text, _word(item, "saved"))
    return kept, rest[length:]


def _word(table: dict[str, Any], key: str) -> str:
    value = table.get(key)
    if not isinstance(value, str) or len(value) > NAME or "\0" in value:
        raise _no(f"its {key} is no name")
    return value


def _no(why: str) -> ReadError:
    return ReadError(f"the journal cannot be read: {why}", advice="Nothing can be recovered of it.")
