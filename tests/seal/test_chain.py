"""The chain: a link is the SHA-256 of every byte before it, and no byte can change unseen."""

from __future__ import annotations

import hashlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.seal.chain import Chain, unlinked

TEXTS = [b'{"a":1}', '{"é":"\u2028"}'.encode(), b'{"chain":"x"}']


def chained(texts: list[bytes]) -> list[bytes]:
    chain = Chain()
    return [chain.linked(text) for text in texts]


def all_hold(lines: list[bytes]) -> bool:
    return not broken(Chain(), lines)


def broken(chain: Chain, lines: list[bytes]) -> int:
    """How many links do not hold; every line is taken in."""
    return sum(not chain.holds(line) for line in lines)


def test_a_link_is_the_sha_256_of_all_bytes_before_it() -> None:
    raw = b"".join(chained(TEXTS))
    for line in raw.splitlines():
        link = line[-66:-2]
        at = raw.index(link)
        assert hashlib.sha256(raw[:at]).hexdigest().encode() == link


def test_a_line_is_its_object_with_one_more_member() -> None:
    (line,) = chained([b'{"a":1}'])
    assert line.startswith(b'{"a":1,"chain":"')
    assert unlinked(line) == (b'{"a":1}', line[-67:-3].decode())


def test_what_was_chained_holds_and_ends_in_the_digest_of_all() -> None:
    lines = chained(TEXTS)
    chain = Chain()
    assert broken(chain, lines) == 0
    assert chain.digest == hashlib.sha256(b"".join(lines)).hexdigest()


@given(st.integers(0, 1_000_000), st.integers(1, 255))
def test_a_byte_that_changed_breaks_the_chain(where: int, by: int) -> None:
    raw = bytearray(b"".join(chained(TEXTS)))
    raw[where % len(raw)] ^= by
    assert not all_hold(bytes(raw).splitlines(keepends=True))


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"\n",
        b"{}\n",
        chained([b'{"a":1}'])[0][:-1],
        chained([b'{"a":1}'])[0].replace(b"\n", b"\r\n"),
        chained([b'{"a":1}'])[0].upper(),
    ],
)
def test_a_line_without_a_link_holds_nothing(line: bytes) -> None:
    assert unlinked(line) is None
    assert not Chain().holds(line)


def test_bytes_without_a_link_count_too() -> None:
    chain, plain = Chain(), Chain()
    chain.add(b"x")
    assert chain.linked(b'{"a":1}') != plain.linked(b'{"a":1}')
