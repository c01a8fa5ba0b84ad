"""A token is asked in a child: whatever its library does, a person gets a sentence."""

from __future__ import annotations

import json
import sys

import pytest

from smsl_studio.errors import SealError
from smsl_studio.seal.token import MODULE, TokenKey, is_token, new_on_token, token_key

PLACE = TokenKey("card", "00ff", "0102")


@pytest.fixture(autouse=True)
def module(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(MODULE, "/nowhere/library.so")


def child(code: str) -> tuple[str, ...]:
    """A child that does this instead of asking a library."""
    return sys.executable, "-c", f"import os, sys, time; asked = sys.stdin.read(); {code}"


def test_a_token_that_hangs_is_given_up() -> None:
    with pytest.raises(SealError, match="the token card gave no answer"):
        PLACE.signature(b"1234", b"signed", child("time.sleep(600)"), 0.2)


@pytest.mark.parametrize(
    "code",
    [
        "os.kill(os.getpid(), 11)",
        "print('no JSON')",
        "print('[]')",
        "sys.exit(3)",
    ],
)
def test_a_library_that_breaks_is_told(code: str) -> None:
    with pytest.raises(SealError, match="the library of the token card ended without an answer"):
        PLACE.signature(b"1234", b"signed", child(code))


@pytest.mark.parametrize("answer", [{}, {"signature": 3}, {"signature": "no base64!"}])
def test_an_answer_without_a_signature_is_refused(answer: dict[str, object]) -> None:
    with pytest.raises(SealError, match="the signature is no"):
        PLACE.signature(b"1234", b"signed", child(f"print({json.dumps(answer)!r})"))


def test_an_answer_without_a_place_is_refused() -> None:
    with pytest.raises(SealError, match="the place of this key on a token"):
        new_on_token("card", b"1234", child("print('{}')"))


def test_a_library_that_is_not_there_is_told() -> None:
    with pytest.raises(SealError, match="the token card: its library does not load"):
        PLACE.signature(b"1234", b"signed")


def test_the_pin_goes_through_the_standard_input() -> None:
    code = "import json; print(json.dumps({'refused': str('MTIzNA' in asked), 'advice': ''}))"
    with pytest.raises(SealError, match="the token card: True"):
        PLACE.signature(b"1234", b"signed", child(code))


def test_a_place_is_read_strictly() -> None:
    assert token_key(PLACE.as_values()) == PLACE
    assert is_token(PLACE.as_values())
    assert not is_token({**PLACE.as_values(), "module": "/tmp/any.so"})
    with pytest.raises(SealError):
        token_key({**PLACE.as_values(), "serial": 7})
