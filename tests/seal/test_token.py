"""A token is asked in a child: whatever its library does, a person gets a sentence."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import SealError
from smsl_studio.seal.strict_json import base64_text
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
        "print('[' * 50_000)",
        "print('[' * 200_000)",
        "print('{\"signature\": \"' + 200_000 * 'A' + '\"}')",
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


@pytest.mark.parametrize("length", [0, 31, 33])
def test_a_public_half_of_another_length_is_refused(length: int) -> None:
    answer = {"serial": "00", "name": "01", "public": base64_text(bytes(length))}
    with pytest.raises(SealError, match="whose public half has not 32 bytes"):
        new_on_token("card", b"1234", child(f"print({json.dumps(answer)!r})"))


def test_an_answer_that_never_ends_is_not_waited_for() -> None:
    code = "[print('x' * 50_000, flush=True) for _ in range(9)]; time.sleep(600)"
    with pytest.raises(SealError, match="ended without an answer"):
        PLACE.signature(b"1234", b"signed", child(code), 60.0)


BINDING = """
from contextlib import nullcontext
from types import SimpleNamespace
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey as Private

Attribute = SimpleNamespace(EC_PARAMS=0, EC_POINT=1)
KeyType = SimpleNamespace(EC_EDWARDS=0)
Mechanism = SimpleNamespace(EDDSA=0, EC_EDWARDS_KEY_PAIR_GEN=1)
ObjectClass = SimpleNamespace(PRIVATE_KEY=0)
REAL, OTHER = Private.from_private_bytes(bytes(32)), Private.from_private_bytes(b"x" * 32)

class Token:
    serial = b"7"
    def open(self, rw, user_pin):
        return nullcontext(self)
    def create_domain_parameters(self, *_, **__):
        return self
    def generate_keypair(self, **_):
        return {1: REAL.public_key().public_bytes_raw()}, None
    def get_key(self, **_):
        return self
    def sign(self, signed, mechanism):
        return SIGNER.sign(signed)

def lib(path):
    return SimpleNamespace(get_token=lambda **_: Token())
"""
"""A library of a token that exists in Python only. What it signs with is named at its end."""


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Puts a library in place of the real one, in the child alone."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def put(end: str) -> None:
        (tmp_path / "pkcs11.py").write_text(f"{BINDING}\n{end}\n")

    return put


def test_a_key_is_kept_only_if_its_token_signs_with_it(library: Callable[[str], None]) -> None:
    library("SIGNER = OTHER")
    with pytest.raises(SealError, match="the token has not signed with the key ada"):
        smsl.make_key("Ada", "engineer", b"1234", "ada", token="card")
    assert smsl.list_keys() == ()
    library("SIGNER = REAL  # and no other")
    assert smsl.make_key("Ada", "engineer", b"1234", "ada", token="card") in smsl.list_keys()


@pytest.mark.parametrize("spelt", ["pin 98é6", "b'98\\xc3\\xa96'", "39 3938C3A936", "OTjDqTY="])
def test_an_error_of_a_library_does_not_tell_the_pin(
    library: Callable[[str], None], spelt: str
) -> None:
    library(f"def lib(path): raise OSError({'x' * 280 + spelt!r})")
    with pytest.raises(SealError) as told:
        PLACE.signature("98é6".encode(), b"signed")
    assert "is not shown, because the PIN stands in it" in told.value.sentence
    assert "xxx" not in told.value.sentence
    with pytest.raises(SealError, match="OSError xxx"):
        PLACE.signature(b"5555", b"signed")


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
