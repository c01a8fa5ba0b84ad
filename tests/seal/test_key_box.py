"""The box around a private key: it opens with its passphrase alone, and keeps what is beside it."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.errors import SealError
from smsl_studio.seal.key_box import boxed, unboxed

SECRET = bytes(range(32))
BOX = boxed(SECRET, b"open", b"Ada")


def test_it_opens_with_its_passphrase() -> None:
    assert unboxed(BOX, b"open", b"Ada") == SECRET
    assert SECRET.hex() not in str(BOX)


@pytest.mark.parametrize(("passphrase", "beside"), [(b"shut", b"Ada"), (b"open", b"Eve")])
def test_it_opens_with_nothing_else(passphrase: bytes, beside: bytes) -> None:
    with pytest.raises(SealError, match="does not open"):
        unboxed(BOX, passphrase, beside)


@pytest.mark.parametrize(
    "change",
    [
        {"n": 1 << 30},
        {"n": 3 << 13},
        {"n": 16},
        {"n": "32768"},
        {"n": True},
        {"kdf": "md5"},
        {"cipher": "none"},
        {"nonce": "AAAA"},
        {"box": "no"},
        {"more": 1},
    ],
)
def test_an_odd_box_is_refused_before_any_work(change: dict[str, Any]) -> None:
    with pytest.raises(SealError):
        unboxed({**BOX, **change}, b"open", b"Ada")


def test_two_boxes_of_one_key_are_different_and_no_passphrase_is_empty() -> None:
    assert boxed(SECRET, b"open", b"")["box"] != boxed(SECRET, b"open", b"")["box"]
    with pytest.raises(SealError, match="empty"):
        boxed(SECRET, b"", b"")
