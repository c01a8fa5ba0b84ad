"""Seeded broken files for the three readers, and what must hold for their results.

Bytes are changed, tokens inserted, texts cut, joined, nested and repeated. The sources are the
samples in all three forms and one text with every unusual feature.
"""

from __future__ import annotations

import copy
import random
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import PurePath

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint, salvage
from smsl_studio.errors import ReadError
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.conversion import convert
from smsl_studio.smsl.document import Document, decode
from smsl_studio.smsl.files import parse_bytes, read_document
from smsl_studio.smsl.forms import form_named, recovered
from smsl_studio.smsl.splice import reconcile

TOKENS = [
    *"{}[]():,#\"/\\'|>&*!%@`?-~=",
    *("\n", "\r\n", "\r", "\t", " ", "\0", "\ufeff", "\u2028", "\x85", "é", "状", "🧠", "\u202e"),
    *("//", "->", "-->", "# ", "# _x: ", "# NAME: ", "# HEADER._x: ", "# SUB_SBS: (", "- ", "? "),
    *("HEADER", "INITIAL", "SUB_SBS", "NUM_FACTS", "_hazards", "_imports", "_facts", "_operations"),
    *("null", "true", "NaN", "-Infinity", "1e999", "9" * 5000, "-", "0x1F", "010", "1.", "\\ud800"),
    *("&a ", "*a", "<<: *a", "!!python/object:os.system ", "!!int ", "%YAML 1.1\n---\n", "\n---\n"),
    *('"_imports": ["fuzz.json"], ', '"S": {"S": 5}, ', "\n...\n", '"""', "'''", "\\u0000", "\\"),
]
OPENERS = ["[", "{", "(", '{"a":', "[{", "- ", "? ", "a: ", "\n ", "{ # NAME: a\n", '"', "// "]

ODD = {
    "json": '{"_x": [1, -0.0, 1e-7, {"é": null}], "_hazards": [{"name": "h", "facts": {"A/0": "1"}}'
    '],\r\n"A": {"HEADER": {"INITIAL": 5, "SUB_SBS": [{"B": 0}], "_c": ""}, "S0": {"a->b": "S0",'
    '"_": 1, "#": "//"}, "_facts": {"0": {"on": "1"}}, "_operations": {"S0/a->b": {"cost": 2}}},'
    '"B": {"0": {"on": "1"}, "1": {}, "_layout": {"0": [1, 2]}}, "B": {}}',
    "smsl": '\ufeff// c\r\n# _x: {"a": [1, "// no"]}\r\n,{ # NAME: "A B"\r\n # INITIAL: S0 // c\r\n'
    '# SUB_SBS: (B: 0)\n # HEADER._y: null\n "S0" : [a -> "S 1",, b->S0 # _z: 1\n] S1:[]\n,,}\n'
    "{ # NAME: B\n # NUM_STATES: 2\n # OTHER: (a: 1, b: 2)\n 0:[ 状->0 ], // x\n 1: [ ]\n}",
    "yaml": "# c\nA: [ # d\n  HEADER: [INITIAL: S0, SUB_SBS: [B: 0], X: {a: [1, 2]}],\n"
    "  S0: [on: No, 010: 12:30, ? 'q' : \"w\\u00e9\"], S1: [], _x: &a {k: ~}\n]\n"
    "B: &b\n  ? long key\n  : a: >- # f\n      x\n  S: {a: S, a: T}\n  _z: *a\nC: *b\n",
}


@lru_cache(maxsize=1)
def sources() -> tuple[tuple[str, str], ...]:
    """Pairs of a form and a text in it."""
    found = list(ODD.items())
    for path in sorted(samples_dir().glob("*.json")):
        if path.stat().st_size > 12_000:
            continue
        document = read_document(path)
        for form in ("json", "smsl", "yaml"):
            found.append((form, convert(document, form, f"x.{form}").document.text))
    return tuple(found)


def files(seed: int, count: int) -> Iterator[tuple[bytes, str]]:
    """``count`` broken files with their names, always the same ones for one seed."""
    chance = random.Random(seed)
    for number in range(count):
        form, text = chance.choice(sources())
        raw = text.encode("utf-8", "surrogatepass")
        for _ in range(chance.choice((1, 1, 1, 2, 3, 8))):
            raw = chance.choice(KINDS)(raw, chance)
        suffix = f".{form}" if chance.random() < 0.85 else chance.choice(("", ".json", ".smsl"))
        yield raw, f"fuzz{number}{suffix}"


def _bytes(raw: bytes, chance: random.Random) -> bytes:
    changed = bytearray(raw or b" ")
    for _ in range(chance.randint(1, 4)):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


def _tokens(raw: bytes, chance: random.Random) -> bytes:
    for _ in range(chance.randint(1, 4)):
        at = chance.randint(0, len(raw))
        token = chance.choice(TOKENS).encode("utf-8", "surrogatepass")
        raw = raw[:at] + token + raw[at + chance.choice((0, 0, 1, 3)) :]
    return raw


def _cut(raw: bytes, chance: random.Random) -> bytes:
    start, end = sorted((chance.randint(0, len(raw)), chance.randint(0, len(raw))))
    return chance.choice((raw[:end], raw[start:], raw[:start] + raw[end:]))


def _joined(raw: bytes, chance: random.Random) -> bytes:
    other = chance.choice(sources())[1].encode("utf-8", "surrogatepass")
    start = chance.randint(0, len(other))
    piece = other[start : start + chance.choice((5, 40, 400, len(other)))]
    at = chance.randint(0, len(raw))
    return raw[:at] + piece + raw[at:]


def _lines(raw: bytes, chance: random.Random) -> bytes:
    lines = raw.split(b"\n")
    one, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    if chance.random() < 0.5:
        lines.insert(other, lines[one])
    else:
        lines[one], lines[other] = lines[other], lines[one]
    return b"\n".join(lines)


def _nested(raw: bytes, chance: random.Random) -> bytes:
    at = chance.randint(0, len(raw))
    times = chance.choice((3, 30, 63, 64, 65, 300, 3000))
    return raw[:at] + chance.choice(OPENERS).encode() * times + raw[at:]


def _repeated(raw: bytes, chance: random.Random) -> bytes:
    at = chance.randint(0, len(raw))
    piece = raw[at : at + chance.choice((1, 2, 5, 20))] or b"["
    times = chance.choice((2, 10, 100, 1000))
    return raw[:at] + piece * times + raw[at:]


KINDS: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    *(_bytes, _tokens, _tokens, _cut, _joined, _lines, _nested, _repeated),
)


@dataclass(frozen=True)
class Answer:
    """What the readers made of one file: whether it opened, and CPU seconds for each 100 KB."""

    accepted: bool
    seconds: float


def look(raw: bytes, file: str) -> Answer:
    """Read one file in every way there is; AssertionError where an answer is none."""
    start = time.process_time()
    accepted = _read(raw, file)
    return Answer(accepted, (time.process_time() - start) / max(1.0, len(raw) / 100_000))


def _read(raw: bytes, file: str) -> bool:
    try:
        text = decode(raw, file)
    except ReadError as error:
        _must_be_told(error, raw.decode("utf-8", "replace"), file)
        return False
    try:
        document = parse_bytes(raw, file)
    except ReadError as error:
        _must_be_told(error, text, file)
        found = recovered(text, file)
        _use(salvage(found))
        return False
    assert document.encoded() == raw
    _must_come_back(document)
    try:
        blueprint = read_blueprint(document)
    except ReadError as error:
        _must_be_told(error, text, file)
        _use(salvage(document))
        return False
    _use(blueprint)
    return True


def _must_come_back(document: Document) -> None:
    assert reconcile(document, copy.deepcopy(dict(document.values))).text == document.text
    assert bool(document.duplicates()) == document.doubled
    again = form_named(document.form).parse(document.text, document.file)
    assert again.values == document.values


def _use(blueprint: Blueprint) -> None:
    """What a window asks of a blueprint at once."""
    document = blueprint.document
    for branch in list(blueprint)[:3]:
        assert document.place((branch.name,)).file == document.file
        for edge in list(branch.edges())[:2]:
            document.place(edge.address.path)
    digests(blueprint)


def _must_be_told(error: ReadError, text: str, file: str) -> None:
    """Every fault has a sentence, an advice and a place within the text; repairs stay in it."""
    lines = re.split("\r\n?|\n", text.removeprefix("\ufeff"))
    assert error.faults
    for fault in error.faults:
        place = fault.place
        assert place is not None, fault.sentence
        assert place.file == file
        assert PurePath(place.file).name == file
        assert 1 <= place.line <= len(lines), (place, len(lines))
        assert 1 <= place.column <= len(lines[place.line - 1]) + 1, (place, fault.sentence)
        assert fault.sentence
        assert fault.advice, fault.sentence
        assert fault.length >= 1
        if fault.fix is not None:
            assert 0 <= fault.fix.start <= fault.fix.end <= len(text)
            assert fault.fix.words
