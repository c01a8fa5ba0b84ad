"""The child that asks a token. It reads one request from its standard input, and writes one answer.

Only this module loads ``pkcs11`` (the extra ``token``), and with it the library of the token.
"""

from __future__ import annotations

import base64
import json
import secrets
import sys
from typing import Any

from smsl_studio.seal.strict_json import base64_text

Json = Any
_CURVE = b"\x13\x0cedwards25519"
"""The parameters of the curve in DER: a PrintableString, as PKCS 11 version 3 wants them."""
_PLAIN = {
    "PinIncorrect": ("the PIN does not open it", "Type it again. Few wrong ones lock the token."),
    "PinLenRange": ("the PIN does not open it", "Type it again. Few wrong ones lock the token."),
    "PinLocked": ("it is locked after wrong PINs", "Unlock it with the tool of its maker."),
    "NoSuchToken": ("it is not here", "Plug it in. Its label must be the one given."),
    "MultipleTokensReturned": ("there are two with this label", "Unplug one of them."),
    "NoSuchKey": ("the key is not on it", "Is it another token with the same label?"),
    "MechanismInvalid": ("it cannot make Ed25519 signatures", "Take another token."),
    "PKCS11Error": ("its library does not load", "SMSL_PKCS11_MODULE must name the right file."),
}
"""For the name of an error of pkcs11, what it says to a person, and what to do."""


def main() -> None:
    """Answer the request on the standard input."""
    request = json.loads(sys.stdin.buffer.read())
    try:
        answer = _answer(request)
    except ImportError:
        answer = {
            "refused": "python-pkcs11 is not installed",
            "advice": "pip install 'smsl-studio[token]'",
        }
    except Exception as error:  # The library of a token can raise anything; the parent tells it.
        kind = type(error).__name__
        unknown = f"{kind} {error}".strip()
        if _tells(unknown, base64.b64decode(request["pin"])):
            unknown = "its library gave an error that is not shown, because the PIN stands in it"
        plain, advice = _PLAIN.get(kind, (unknown[:300], "Nothing was signed."))
        answer = {"refused": plain, "advice": advice}
    sys.stdout.write(json.dumps(answer))


def _tells(text: str, pin: bytes) -> bool:
    """Whether a text contains the PIN, also as a library or Python may spell its bytes."""
    plain = pin.decode("utf-8", "replace")
    spelt = (plain, ascii(plain)[1:-1], repr(pin)[2:-1], pin.hex(), base64_text(pin))
    return any(one and one.casefold() in text.casefold() for one in spelt)


def _answer(request: dict[str, Json]) -> dict[str, Json]:
    import pkcs11
    from pkcs11 import Attribute, KeyType, Mechanism, ObjectClass

    wanted = {"token_label": request["token"]}
    if serial := request.get("serial"):
        wanted["token_serial"] = bytes.fromhex(serial)
    token = pkcs11.lib(request["module"]).get_token(**wanted)
    pin = base64.b64decode(request["pin"]).decode("utf-8", "replace")
    with token.open(rw=request["do"] == "make", user_pin=pin) as session:
        if request["do"] == "sign":
            key: Any = session.get_key(
                object_class=ObjectClass.PRIVATE_KEY, id=bytes.fromhex(request["name"])
            )
            signed = base64.b64decode(request["signed"])
            made = key.sign(signed, mechanism=Mechanism.EDDSA)
            return {"signature": base64_text(made)}
        name = secrets.token_bytes(16)
        curve = session.create_domain_parameters(
            KeyType.EC_EDWARDS, {Attribute.EC_PARAMS: _CURVE}, local=True
        )
        public, _ = curve.generate_keypair(
            mechanism=Mechanism.EC_EDWARDS_KEY_PAIR_GEN, store=True, id=name, label="SMSL Studio"
        )
        # The point is 32 bytes; most tokens put an octet string around it (two bytes more).
        point = bytes(public[Attribute.EC_POINT])[-32:]
        return {
            "serial": bytes(token.serial).hex(),
            "name": name.hex(),
            "public": base64_text(point),
        }
