"""Keys on a token, such as a smart card: the private half is made there and never leaves it.

The token is asked through its PKCS 11 library, in a child with a time limit, because a wrong call
can hang or crash. The library is named by ``SMSL_PKCS11_MODULE``, never by a file of the store: its
code runs here. Without it, the first known library that is installed is taken.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from smsl_studio.errors import SealError
from smsl_studio.seal.ed25519 import LENGTH
from smsl_studio.seal.strict_json import base64_text, from_base64

Json = Any
MODULE = "SMSL_PKCS11_MODULE"
SECONDS = 30.0
"""How long a token may take for an answer (s). A person may have to press its button."""
_KNOWN = (
    "lib/*/opensc-pkcs11.so",
    "lib/opensc-pkcs11.so",
    "lib/softhsm/libsofthsm2.so",
    "lib/*/softhsm/libsofthsm2.so",
)
_LONGEST = 100_000
"""The longest answer of the child that is read (bytes)."""
_MOST = 200
"""The most letters of a label, a serial number or a key's name on a token."""


@dataclass(frozen=True, slots=True)
class TokenKey:
    """Where a private key is: the label and serial number of the token, and the key's name there
    (hexadecimal digits).
    """

    label: str
    serial: str
    name: str

    def as_values(self) -> dict[str, Json]:
        """Return the place as plain values, for the key's file."""
        return {"token": self.label, "serial": self.serial, "name": self.name}

    def signature(
        self, pin: bytes, signed: bytes, child: Sequence[str] = (), seconds: float = SECONDS
    ) -> bytes:
        """Return the Ed25519 signature of some bytes, which the token makes.

        SealError if the token is not here, does not open with this PIN, or gives no answer in time.
        """
        asked = {"do": "sign", **self.as_values(), "signed": base64_text(signed)}
        return from_base64(_answer(asked, pin, child, seconds).get("signature"), "the signature")


def is_token(values: Json) -> bool:
    """Whether the values say that a private key is on a token."""
    return isinstance(values, dict) and set(values) == {"token", "serial", "name"}


def token_key(values: Json) -> TokenKey:
    """Return the place of a key. SealError if a value is no text, or is very long."""
    texts = [values[key] for key in ("token", "serial", "name")]
    if not all(isinstance(text, str) and len(text) <= _MOST for text in texts):
        raise SealError("the place of this key on a token is not as Studio writes it")
    return TokenKey(*texts)


def new_on_token(
    label: str, pin: bytes, child: Sequence[str] = (), seconds: float = SECONDS
) -> tuple[TokenKey, bytes]:
    """Make a key on the token with this label. Return its place and its public half.

    SealError if the token is not here, does not open with this PIN, cannot make Ed25519 keys, or
    gives no answer in time. Nobody has proved yet that the token signs with this key.
    """
    if len(label) > _MOST:
        raise SealError(f"the label of a token has at most {_MOST} letters")
    made = _answer({"do": "make", "token": label}, pin, child, seconds)
    place = token_key({"token": label, "serial": made.get("serial"), "name": made.get("name")})
    public = from_base64(made.get("public"), "the public half")
    if len(public) != LENGTH:
        raise SealError(
            f"the token {label} has made a key whose public half has not {LENGTH} bytes",
            advice="Nothing was kept. It cannot make Ed25519 keys as Studio needs them.",
        )
    return place, public


def _answer(
    asked: Mapping[str, Json], pin: bytes, child: Sequence[str], seconds: float
) -> Mapping[str, Json]:
    """Ask the child. The PIN goes through its standard input, where no other program reads it."""
    request = {**asked, "pin": base64_text(pin), "module": _module()}
    whose = f"the token {asked['token']}"
    raw = json.dumps(request).encode("ascii")
    try:
        status, told = _told(list(child) or _child(), raw, seconds)
    except subprocess.TimeoutExpired:
        raise SealError(
            f"{whose} gave no answer in {seconds:g} s",
            advice="Nothing was signed. Unplug it, plug it in, and try again.",
        ) from None
    try:
        answer = json.loads(told) if len(told) <= _LONGEST else None
    except (ValueError, RecursionError):
        answer = None
    if not isinstance(answer, dict):
        raise SealError(
            f"the library of {whose} ended without an answer (exit {status})",
            advice=f"Nothing was signed. Does {MODULE} name the library of this token?",
        )
    if "refused" in answer:
        raise SealError(f"{whose}: {answer['refused']}", advice=str(answer.get("advice", "")))
    return answer


def _told(command: Sequence[str], request: bytes, seconds: float) -> tuple[int, bytes]:
    """Return the exit status of the child, and what it wrote, up to one byte too many.

    TimeoutExpired if it takes longer. The child has ended then, too.
    """
    due = time.monotonic() + seconds
    child = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    )
    assert child.stdin is not None
    assert child.stdout is not None
    read: list[bytes] = []
    talk = threading.Thread(target=_talk, args=(child.stdin, child.stdout, request, read))
    talk.daemon = True  # A process of the library may keep the pipe open for ever.
    talk.start()
    try:
        talk.join(seconds)
        if talk.is_alive():
            raise subprocess.TimeoutExpired(command, seconds)
        if len(read[0]) > _LONGEST:
            child.kill()
        return child.wait(max(0.0, due - time.monotonic())), read[0]
    finally:
        child.kill()
        child.wait()


def _talk(request_to: IO[bytes], answer_of: IO[bytes], request: bytes, read: list[bytes]) -> None:
    """Write the request, read the answer, and close both pipes."""
    with answer_of:
        with suppress(OSError), request_to:
            request_to.write(request)
        read.append(answer_of.read(_LONGEST + 1))


def _child() -> list[str]:
    """Return the command of the child. It looks for modules where this process does."""
    code = f"import sys; sys.path[:] = {sys.path!r}; from smsl_studio.seal import token_child; "
    return [sys.executable, "-P", "-c", f"{code}token_child.main()"]


def _module() -> str:
    """Return the path of the PKCS 11 library. SealError if there is none."""
    if named := os.environ.get(MODULE):
        return named
    for pattern in _KNOWN:
        for found in sorted(Path("/usr").glob(pattern)):
            return str(found)
    raise SealError(
        "there is no library for tokens (PKCS 11) on this computer",
        advice=f"Install the one of your token, and name it in {MODULE}.",
    )
