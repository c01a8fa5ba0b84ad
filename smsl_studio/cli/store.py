"""``store``: revokes records and blueprints by their digests, for this user."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output
from smsl_studio.cli.passphrase import add_passphrase, passphrase
from smsl_studio.errors import UsageError
from smsl_studio.front.key_ring import revoke_digest
from smsl_studio.legible import one_line

VERBS = ("revoke",)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``store``."""
    parser.add_argument("verb", choices=VERBS, help="revoke a record or a blueprint")
    parser.add_argument("digest", metavar="DIGEST", help="its SHA-256: sha256:... or 64 digits")
    parser.add_argument("--key", metavar="ID", help="a key of the store, which shows who you are")
    parser.add_argument("--why", metavar="TEXT", help="the reason")
    add_passphrase(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Revoke a digest. Return 0 if it is revoked, and 2 if that is not possible."""
    for name in ("key", "why"):
        if not getattr(options, name):
            raise UsageError(f"store revoke needs --{name}", advice="smsl-studio store --help")
    words = passphrase(options.passphrase_file, options.key)
    digest = revoke_digest(options.digest, options.why, options.key, words)
    if options.format == "json":
        out.json({"revoked": f"sha256:{digest}", "why": options.why})
    else:
        out.line(one_line(f"sha256:{digest}: revoked: {options.why}"))
    return 0
