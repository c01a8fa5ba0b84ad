"""A blueprint in which every name is hostile, and the text that must never appear in an output."""

from __future__ import annotations

import json
import unicodedata
from pathlib import Path

TAG, BOLD = "<img src=x>", "<b>bold</b>"
STEERS, TURNS, HIDES = "\x1b[31m\x00\x9b", "\u202e\u2066", "\u200b\u3164"
MARKS = "".join(
    map(
        chr,
        (
            *range(0x7F, 0xA0),
            *(0x61C, 0x200E, 0x200F, 0x2028, 0x2029),
            *range(0x202A, 0x202F),
            *range(0x2066, 0x206A),
        ),
    )
)
"""C1 controls (with U+0085), line and paragraph separators, and every mark of direction."""

BRANCH = f"{BOLD}{TURNS}SB"
FIRST, SECOND = f"{TAG}{STEERS}State_0", f"{TAG}\n{HIDES}State_1"
OPERATION = f"{TAG}{TURNS}Op{STEERS}{HIDES}"
BLUEPRINT = {
    "_hazards": {f"{TAG}{TURNS}hazard": {f"{BRANCH}/0": "1"}},
    BRANCH: {
        "HEADER": {"INITIAL": FIRST, "ACTIVATING": SECOND, "NUM_FACTS": 1, f"{TAG}{TURNS}KEY": 1},
        "_facts": {"0": {"name": f"{TAG}{TURNS}fact", "values": {"1": f"{BOLD}{TURNS}on"}}},
        "_states": {FIRST: {"title": f"{TAG}{TURNS}title"}},
        "_notes": {
            f"{TAG}{TURNS}": {
                "text": f"{TAG}\n{STEERS}{TURNS}",
                "author": f"{BOLD}{TURNS}",
                "date": f"{TAG}{HIDES}",
                "at": [0, -150],
                "state": FIRST,
            },
        },
        "_layout": {
            "_groups": {f"{TAG}{TURNS}": {"title": f"{TAG}{TURNS}group", "states": [FIRST, SECOND]}}
        },
        FIRST: {OPERATION: SECOND, f"{OPERATION}2": f"{SECOND}gone"},
        SECOND: {f"back{OPERATION}": FIRST},
    },
}


def write_hostile(folder: Path, without: str = "") -> Path:
    """The blueprint, in a file whose name is hostile, too; every target exists.

    Its names have none of the characters of ``without``.
    """
    text = json.dumps(BLUEPRINT, ensure_ascii=False)
    for char in without:
        text = text.replace(json.dumps(char).strip('"'), "").replace(char, "")
    values = json.loads(text)
    states = next(states for name, states in values.items() if not name.startswith("_"))
    operations = next(found for name, found in states.items() if name.endswith("State_0"))
    operations.pop(next(name for name in operations if name.endswith("2")))
    file = folder / f"{BOLD.replace('/', '')}{TURNS}\x1b[31m.json"
    file.write_text(json.dumps(values, indent=4), "utf-8")
    return file


def hidden(text: str) -> list[str]:
    """The characters of a text that steer a terminal, turn it round, or cannot be seen."""
    kinds = ("Cc", "Cf", "Cs", "Cn", "Zl", "Zp")
    return [
        repr(char)
        for char in text
        if char not in "\n\t" and (unicodedata.category(char) in kinds or char == "\u3164")
    ]
