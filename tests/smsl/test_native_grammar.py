"""The hand-written reader accepts and rejects the same texts as a grammar."""

from __future__ import annotations

import random
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import ReadError
from smsl_studio.smsl.native_form import parse
from tests.counts import share_of
from tests.smsl.native_grammar import accepts
from tests.smsl.native_texts import native

_TOKEN = re.compile(r'#[^\n]*\n|//[^\n]*\n|"[^"\n]*"|->|[{}\[\]:,]|[\w.~-]+|\s+|.')
_PIECES = ["{", "}", "[", "]", ":", ",", "->", "a", '"b c"', "=>", ">", "/", "(", "HEADER", "-"]
_PIECES += ["# NAME: A\n", "# INITIAL: a // c\n", "# SUB_SBS: (b: 1, c: 0)\n", "# _x: 5\n", "#\n"]
_PIECES += ["# HEADER._y: {}\n", "# NUM_FACTS: 2\n", "# INITIAL: a b\n", "// x -> y ]\n", "\n", '"']

_NAMES = st.sampled_from(["a", "b-c", "d e", "S0", "HEADER x", "é"])
_STATES = st.dictionaries(_NAMES, st.dictionaries(_NAMES, _NAMES, max_size=2), max_size=3)
_HEADERS = st.fixed_dictionaries(
    {},
    optional={"INITIAL": _NAMES, "NUM_FACTS": st.integers(0, 9), "_x": st.integers(0, 9)},
)
_BRANCHES = st.builds(lambda header, states: {"HEADER": header, **states}, _HEADERS, _STATES)


def opens(text: str) -> bool:
    try:
        parse(text, "f.smsl")
    except ReadError:
        return False
    return True


@settings(max_examples=share_of(120), deadline=None)
@given(st.dictionaries(_NAMES, _BRANCHES, max_size=2), st.integers(0, 10**6))
def test_the_reader_and_the_grammar_agree(values: dict[str, object], seed: int) -> None:
    chance = random.Random(seed)
    tokens = _TOKEN.findall(native(values, seed).removeprefix("\ufeff").replace("\r", "\n"))
    assert accepts("".join(tokens))
    for _ in range(4):
        damaged = list(tokens)
        for _ in range(chance.randint(1, 2)):
            at = chance.randrange(len(damaged) + 1)
            kind = chance.randrange(3)
            damaged[at : at + (kind > 0)] = [] if kind == 1 else [" ", chance.choice(_PIECES), " "]
        text = "".join(damaged)
        assert opens(text) == accepts(text), text


@pytest.mark.parametrize("size", range(1, 9))
def test_they_agree_on_short_texts_of_any_tokens(size: int) -> None:
    chance = random.Random(size)
    for _ in range(40):
        inner = " ".join(chance.choice(_PIECES) for _ in range(size))
        for text in (inner, f"{{\n# NAME: A\n{inner} }}", f"{{\n# NAME: A\nS: [ {inner} ] }}"):
            assert opens(text) == accepts(text), text
