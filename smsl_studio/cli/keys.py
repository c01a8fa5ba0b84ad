"""``keys``: makes, lists, exports, imports and revokes keys, which sign records and registers."""

from __future__ import annotations

import argparse
from typing import Any

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.passphrase import add_passphrase, copy_passphrase, new_passphrase, passphrase
from smsl_studio.errors import UsageError
from smsl_studio.front.key_ring import (
    export_key,
    import_key,
    list_keys,
    make_key,
    revoke_key,
    sign_register,
)
from smsl_studio.inspection.approval.key_store import StoredKey, stored_key
from smsl_studio.legible import one_line
from smsl_studio.seal.strict_json import base64_text

VERBS = {
    "make": ("person", "role"),
    "list": (),
    "show": ("name",),
    "export": ("name", "output"),
    "import": ("name",),
    "register": ("name", "key", "output"),
    "revoke": ("name", "why"),
}
"""For each verb, the arguments that it needs."""

ALSO = {
    "make": ("id", "passphrase_file", "token"),
    "export": ("private", "passphrase_file", "new_passphrase_file"),
    "import": ("id",),
    "register": ("passphrase_file",),
    "revoke": ("key", "passphrase_file"),
}
"""For each verb, the arguments that it also accepts."""

_SHOWN = {
    "name": "a name",
    "output": "-o FILE",
    "person": "--person NAME",
    "role": "--role ROLE",
    "why": "--why TEXT",
    "key": "--key ID",
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``keys``."""
    parser.add_argument("verb", choices=tuple(VERBS), help="what to do with keys")
    parser.add_argument(
        "name",
        nargs="?",
        metavar="ID|FILE",
        help="the key, by its local name or its identity; the file to import; the persons of a "
        "register",
    )
    parser.add_argument("--person", metavar="NAME", help="whose key is made")
    parser.add_argument("--role", help="the person's role; 'automatic' never counts as a person")
    parser.add_argument("--id", metavar="ID", help="the local name of the key")
    parser.add_argument(
        "--token",
        metavar="LABEL",
        help="make the key on the token with this label; the passphrase is its PIN",
    )
    parser.add_argument("--key", metavar="ID", help="the key that signs or revokes")
    parser.add_argument("--why", metavar="TEXT", help="why a key is revoked")
    parser.add_argument(
        "--private",
        action="store_true",
        default=None,
        help="export both halves, with a new passphrase",
    )
    parser.add_argument("-o", "--output", metavar="FILE", help="the file to write")
    add_passphrase(parser)
    parser.add_argument(
        "--new-passphrase-file",
        metavar="FILE",
        help="the passphrase of the exported copy (else SMSL_NEW_PASSPHRASE, else a prompt)",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Do what the verb says. Return 0 if it is done, and 2 if it is not possible."""
    _check(options)
    if options.verb == "list":
        return _list(options.format == "json", out)
    key = _done(options)
    if options.format == "json":
        out.json(key_as_json(key))
    else:
        _print(key, out)
    return 0


def _done(options: argparse.Namespace) -> StoredKey:
    name = options.name
    if options.verb == "make":
        person, role, key_id = options.person, options.role, options.id or ""
        if options.token:
            pin = passphrase(options, f"the token {options.token}")
            return make_key(person, role, pin, key_id, token=options.token)
        return make_key(person, role, new_passphrase(options, person), key_id)
    if options.verb == "show":
        return stored_key(name)
    if options.verb == "import":
        return import_key(name, options.id or "")
    if options.verb == "export":
        if not options.private:
            return export_key(name, options.output)
        old = passphrase(options, name)
        return export_key(name, options.output, old, copy_passphrase(options, name))
    if options.verb == "register":
        return sign_register(name, options.key, passphrase(options, options.key), options.output)
    by = options.key or name
    return revoke_key(name, options.why, passphrase(options, by), by)


def _check(options: argparse.Namespace) -> None:
    """Raise UsageError if the verb needs an argument that is missing, or does not accept one."""
    needed = VERBS[options.verb]
    taken = {*needed, *ALSO.get(options.verb, ())}
    for one in needed:
        if not getattr(options, one):
            raise UsageError(
                f"keys {options.verb} needs {_SHOWN[one]}",
                advice="smsl-studio keys --help says what it takes.",
            )
    every = {*_SHOWN, "id", "private", "passphrase_file", "new_passphrase_file", "token"}
    for one in sorted(every - taken):
        if getattr(options, one) is not None:
            shown = _SHOWN.get(one) or f"--{one.replace('_', '-')}"
            raise UsageError(f"keys {options.verb} does not take {shown}", advice="Leave it out.")


def _list(as_json: bool, out: Output) -> int:
    found = list_keys()
    if as_json:
        out.json({"keys": [key_as_json(one) for one in found]})
        return 0
    for one in found:
        _print(one, out)
    if not found:
        note("There are no keys. smsl-studio keys make --person NAME --role ROLE makes one.")
    return 0


def key_as_json(key: StoredKey) -> dict[str, Any]:
    """Return a key as plain values, without its private half."""
    return {
        "id": key.id,
        "person": key.person,
        "role": key.role,
        "key": key.identity,
        "public": base64_text(key.public),
        "private": key.box is not None,
        "token": key.token.label if key.token else None,
        "made": key.made,
        "revoked": key.revoked or None,
    }


def _print(key: StoredKey, out: Output) -> None:
    half = "" if key.box is not None else ", public half"
    if key.token:
        half = f", on the token {key.token.label}"
    out.line(one_line(f"{key.id}: {key.person} ({key.role}){half}"))
    out.line(f"    {key.identity}")
    out.line(f"    public: {base64_text(key.public)}")
    if key.revoked:
        out.line(one_line(f"    revoked: {key.revoked}"))
