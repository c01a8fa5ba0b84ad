"""Generated SMSL documents: any values, in any layout a person or a program might write."""

from __future__ import annotations

import json
import random
import re
from typing import Any

from hypothesis import strategies as st

Json = Any

_PLAIN = ["SB1", "SB2", "State0", "State1", "State_ab", "Op_1b", "a/b", "~", "x", "on", "Größe"]
NAMES = st.one_of(
    st.sampled_from(_PLAIN),
    st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=6),
).filter(lambda name: not name.startswith("_") and name != "HEADER")
NOTES = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(-9, 9), st.sampled_from(["", "note", "{,\\"])),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3),
    max_leaves=6,
)
SKIPPED = st.dictionaries(st.sampled_from(["_comment", "_layout", "_x"]), NOTES, max_size=1)
STATES = st.builds(
    lambda edges, skipped: {**edges, **skipped},
    st.dictionaries(NAMES, NAMES, max_size=3),
    SKIPPED,
)
HEADERS = st.builds(
    lambda known, skipped: {**known, **skipped},
    st.fixed_dictionaries(
        {},
        optional={
            "INITIAL": NAMES,
            "ACTIVATING": NAMES,
            "NUM_FACTS": st.integers(1, 3),
            "SUB_SBS": st.dictionaries(NAMES, st.integers(0, 3), max_size=2)
            | st.lists(st.dictionaries(NAMES, st.integers(0, 3), min_size=1, max_size=1)),
            "OTHER": NOTES,
        },
    ),
    SKIPPED,
)
BRANCHES = st.builds(
    lambda header, states, skipped: {**header, **states, **skipped},
    st.one_of(st.just({}), HEADERS.map(lambda header: {"HEADER": header})),
    st.dictionaries(NAMES, STATES, max_size=4),
    SKIPPED,
)
VALUES = st.builds(
    lambda before, branches, after: {**before, **branches, **after},
    SKIPPED,
    st.dictionaries(NAMES, BRANCHES, max_size=3),
    SKIPPED,
)

_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')
_SPACES = ["", "", " ", "\n", "\n\n    ", "\t", "\r\n"]


@st.composite
def texts(draw: st.DrawFn, values: st.SearchStrategy[Json] = VALUES) -> str:
    """A text of generated values in a generated layout."""
    return written(draw(values), draw(st.integers(0, 10**6)))


def written(values: Json, seed: int) -> str:
    """The values in one of very many layouts, chosen by the seed."""
    chance = random.Random(seed)
    indent = chance.choice([4, 4, 2, 1, "\t", None])
    separators = chance.choice([(",", ":"), (",", ": "), (", ", ": "), (" ,", " : ")])
    if indent is not None:
        separators = (separators[0].rstrip(), separators[1])
    ascii_only = chance.random() < 0.3
    text = json.dumps(values, ensure_ascii=ascii_only, indent=indent, separators=separators)
    kind = chance.random()
    if kind < 0.2:
        text = scattered(text, chance)
    elif kind < 0.4:
        text = text.replace("\n", "\r\n")
    bom = "\ufeff" if chance.random() < 0.2 else ""
    return bom + text + chance.choice(["", "\n", "\n\n", " "])


def scattered(text: str, chance: random.Random) -> str:
    """The same tokens with any white space between them."""
    return "".join(token + chance.choice(_SPACES) for token in _TOKEN.findall(text))
