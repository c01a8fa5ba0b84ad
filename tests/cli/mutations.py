"""Seeded small mutations of the samples: characters, lines, keys and values that go wrong."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from pathlib import Path

from smsl_studio.shipped import samples_dir

CHARS = '{}[]",:_/\\0aé\u2028\ufeff\x00 \n'
VALUES: tuple[object, ...] = (None, True, 0, -1, 10**20, 1.5, "", "x", "State_aaa", [], {}, [{}])


def mutations(seed: int, count: int) -> Iterator[bytes]:
    """``count`` broken files, always the same ones for one seed."""
    draw = random.Random(seed)
    texts = [path.read_text("utf-8") for path in sorted(Path(samples_dir()).glob("*.json"))]
    for _ in range(count):
        yield draw.choice(KINDS)(draw.choice(texts), draw)


def _characters(text: str, draw: random.Random) -> bytes:
    for _ in range(draw.randint(1, 3)):
        at = draw.randrange(len(text))
        text = text[:at] + draw.choice(["", draw.choice(CHARS)]) + text[at + draw.randint(0, 2) :]
    return text.encode()


def _bytes(text: str, draw: random.Random) -> bytes:
    raw = bytearray(text.encode())
    raw[draw.randrange(len(raw))] = draw.randrange(256)
    return bytes(raw)


def _lines(text: str, draw: random.Random) -> bytes:
    lines = text.splitlines(keepends=True)
    one, other = draw.randrange(len(lines)), draw.randrange(len(lines))
    how = draw.choice(("drop", "double", "swap", "cut"))
    if how == "drop":
        del lines[one]
    elif how == "double":
        lines.insert(other, lines[one])
    elif how == "swap":
        lines[one], lines[other] = lines[other], lines[one]
    else:
        lines = lines[:one]
    return "".join(lines).encode()


def _values(text: str, draw: random.Random) -> bytes:
    values = json.loads(text)
    for _ in range(draw.randint(1, 3)):
        inner = draw.choice(list(_objects(values)))
        header = draw.choice(("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES", "_x"))
        key = draw.choice([*inner, header, "New"])
        what = draw.choice(("set", "drop", "rename", "point"))
        if what == "drop":
            inner.pop(key, None)
        elif what == "rename":
            inner[draw.choice(("", "/", "a/b~", "State_", key + "x"))] = inner.pop(key, "y")
        elif what == "set":
            inner[key] = draw.choice(VALUES)
        else:
            inner[key] = draw.choice([*inner, "Nowhere"])
    return json.dumps(values, indent=draw.choice((None, 1, 4))).encode()


def _objects(value: object) -> Iterator[dict[str, object]]:
    if isinstance(value, dict):
        yield value
        for inner in value.values():
            yield from _objects(inner)


KINDS: tuple[Callable[[str, random.Random], bytes], ...] = (_characters, _bytes, _lines, _values)
