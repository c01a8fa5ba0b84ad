"""Broken and hostile files of other programs, always the same ones for one seed."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path
from random import Random

import smsl_studio as smsl
from smsl_studio.shipped import samples_dir
from tests.exchange import foreign
from tests.exchange.again import WHOLE, text_of

CORE = "core_data.json"
NAMES = ("x.scxml", "x.graphml", "x.xstate.json", "x.py", "x.xml", CORE)
"""The names of the files of every importer."""

TOKENS = (
    *("<", ">", "/>", '"', "'", "&", "&amp;", "&#0;", "&#x110000;", "&bomb;", "]]>", "<![CDATA["),
    *('<!DOCTYPE a [<!ENTITY b "b">]>', "<?xml version='9'?>", "<!--", "-->", "<?php ?>"),
    '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>&x;',
    '<xi:include href="x.scxml"/>',
    '<script src="http://127.0.0.1:9/x.js">boom()</script>',
    '<invoke src="x.scxml" type="scxml"/>',
    '<state id="x" src="x.scxml"/>',
    ' id="idle"',
    ' target="idle nowhere"',
    *("\0", "\x1b[31m", "\u202e", "\ufeff", "状態", "🧠", "\ud800", "\r", "\n", "\t", " "),
    *("{", "}", "[", "]", ":", ",", "null", "true", "-1", "1e999", "9" * 5000, '"\\ud800"'),
    *('"__proto__": {}, ', '"states": 5, ', '"on": [[]], ', '"target": {}, ', '"initial": 7, '),
    *("_imports", "HEADER", "_", "smsl", '"smsl": {"file": {"_imports": ["/etc/passwd"]}}, '),
    *("(", ")", "\\", "lambda: 0", "with x:", "def create(self):", "return x", "    ", "'''"),
    *(
        "import os; os.system('x')",
        "_sm_work_0",
        "transitions={**x}",
        "outcomes=y",
        "# coding: x\n",
    ),
    *('"state_id": "ROOT", ', '"transitions": [5], ', '"outcomes": null, ', '"to_state": [], '),
)
OPENERS = (
    "<a>",
    "<state>",
    "<graph>",
    "[",
    "{",
    '{"states": {"a": ',
    "(",
    "-",
    "not ",
    "lambda: ",
    "a.",
)


@lru_cache(maxsize=1)
def sources() -> dict[str, tuple[str, ...]]:
    """Good texts for each name."""
    found: dict[str, list[str]] = {name: [] for name in NAMES}
    found["x.scxml"].append(foreign.SCXML)
    found["x.xstate.json"].append(json.dumps(foreign.XSTATE, indent=1))
    found["x.graphml"].append(foreign.GRAPHML)
    found["x.py"].append(foreign.FLEXBE)
    found["x.xml"].append(foreign.MANIFEST)
    found[CORE].append(json.dumps({"state_id": "A", "outcomes": {"0": {"outcome_id": 0}},
                                   "transitions": {"1": {"to_state": "B"}}}))  # fmt: skip
    for name in ("hfsm", "registration-digitization", "three-levels"):
        blueprint = smsl.read(samples_dir() / f"{name}.json")
        for suffix in WHOLE:
            found[f"x{suffix}"].append(text_of(blueprint, suffix))
    return {name: tuple(texts) for name, texts in found.items()}


def broken(seed: int, count: int, name: str) -> Iterator[bytes]:
    """Yield broken texts for one importer."""
    chance = Random(f"{seed} {name}")
    for _ in range(count):
        raw = chance.choice(sources()[name]).encode()
        for _ in range(chance.choice((1, 1, 2, 3, 8))):
            raw = chance.choice(KINDS)(raw, chance)
        yield raw


def _bytes(raw: bytes, chance: Random) -> bytes:
    changed = bytearray(raw or b" ")
    for _ in range(chance.randint(1, 4)):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed)


def _tokens(raw: bytes, chance: Random) -> bytes:
    for _ in range(chance.randint(1, 4)):
        at = chance.randint(0, len(raw))
        token = chance.choice(TOKENS).encode("utf-8", "surrogatepass")
        raw = raw[:at] + token + raw[at + chance.choice((0, 0, 1, 3)) :]
    return raw


def _cut(raw: bytes, chance: Random) -> bytes:
    start, end = sorted((chance.randint(0, len(raw)), chance.randint(0, len(raw))))
    return chance.choice((raw[:end], raw[start:], raw[:start] + raw[end:]))


def _moved(raw: bytes, chance: Random) -> bytes:
    """Put a piece of the text somewhere else, several times."""
    start = chance.randint(0, len(raw))
    piece = raw[start : start + chance.choice((5, 40, 400))]
    at = chance.randint(0, len(raw))
    return raw[:at] + piece * chance.choice((1, 1, 2, 30)) + raw[at:]


def _nested(raw: bytes, chance: Random) -> bytes:
    at = chance.randint(0, len(raw))
    times = chance.choice((3, 63, 65, 250, 3000, 30_000))
    return raw[:at] + chance.choice(OPENERS).encode() * times + raw[at:]


def _words(raw: bytes, chance: Random) -> bytes:
    """Exchange two quoted words, so that ids and targets lead elsewhere."""
    parts = raw.split(b'"')
    one, other = chance.randrange(len(parts)), chance.randrange(len(parts))
    parts[one], parts[other] = parts[other], parts[one]
    return b'"'.join(parts)


KINDS: tuple[Callable[[bytes, Random], bytes], ...] = (
    *(_bytes, _tokens, _tokens, _cut, _moved, _words, _words, _nested),
)


def put(raw: bytes, name: str, folder: Path) -> Path:
    """Write a file into a folder of its own, with what its importer needs beside it."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(raw)
    if name == "x.xml":
        (folder / "bone_drill_sm.py").write_text(foreign.FLEXBE, "utf-8")
    if name == CORE:
        foreign.write_state(folder / "B", "B", "B", "ExecutionState", ["done"], [])
    return folder / name
