"""Reads passphrases of keys: from a file, from ``SMSL_PASSPHRASE``, or from a prompt.

They are never arguments of a command, because every program on the computer could read them there.
"""

from __future__ import annotations

import argparse
import getpass
import sys
from pathlib import Path

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import note
from smsl_studio.cli.secrets_apart import NEW_VARIABLE, VARIABLE
from smsl_studio.errors import UsageError
from smsl_studio.smsl.files import read_content

MOST = 10_000


def add_passphrase(parser: ArgumentParser) -> None:
    """Add ``--passphrase-file FILE``."""
    parser.add_argument(
        "--passphrase-file",
        metavar="FILE",
        help="the first line of this file is the passphrase (else SMSL_PASSPHRASE, else a prompt)",
    )


def passphrase(options: argparse.Namespace, whose: str) -> bytes:
    """Return the passphrase of a key. The prompt calls the key ``whose``.

    ``options`` are those of a command: the file, and what the environment gave (``Secrets``).

    UsageError if there is no passphrase and no terminal for a prompt.
    """
    given = _given(options, options.passphrase_file, VARIABLE)
    return given or _typed(f"Passphrase of {whose}: ", "--passphrase-file")


def recorder_passphrase(options: argparse.Namespace) -> bytes:
    """Return the passphrase of the key with which this computer signs its logs.

    It is empty if there is no such key. It is also empty if nobody gives a passphrase and there is
    no terminal for a prompt. Then a note says that the log is not signed.
    """
    from smsl_studio.front.log_seals import recorder_name

    name = recorder_name()
    if not name:
        return b""
    given = _given(options, options.passphrase_file, VARIABLE)
    if given:
        return given
    if not _has_terminal():
        note(f"the log is not signed: there is no passphrase for {name}")
        return b""
    return _typed(f"Passphrase of {name}, which signs the log: ", "--passphrase-file")


def new_passphrase(options: argparse.Namespace, whose: str) -> bytes:
    """Return a passphrase for a new key. A prompt asks for it twice."""
    given = _given(options, options.passphrase_file, VARIABLE)
    return given or _typed_twice(whose, "--passphrase-file")


def copy_passphrase(options: argparse.Namespace, whose: str) -> bytes:
    """Return a passphrase for the exported copy of a key. A prompt asks for it twice."""
    given = _given(options, options.new_passphrase_file, NEW_VARIABLE)
    return given or _typed_twice(f"the copy of {whose}", "--new-passphrase-file")


def _given(options: argparse.Namespace, file: str | None, variable: str) -> bytes:
    if file is None:
        found: bytes = options.secrets.given(variable)
        return found[:MOST]
    line = read_content(Path(file)).raw.split(b"\n", 1)[0].removesuffix(b"\r")[:MOST]
    if not line:
        raise UsageError(f"the first line of {file} is empty", advice="Write the passphrase there.")
    return line


def _typed_twice(whose: str, option: str) -> bytes:
    first = _typed(f"New passphrase of {whose}: ", option)
    if _typed("The same again: ", option) != first:
        raise UsageError("the two passphrases differ", advice="Nothing was changed. Try again.")
    return first


def _has_terminal() -> bool:
    try:
        return sys.stdin is not None and sys.stdin.isatty()
    except ValueError:
        return False


def _typed(prompt: str, option: str) -> bytes:
    if not _has_terminal():
        raise UsageError(
            "there is no passphrase, and nobody to ask for it",
            advice=f"Name a file with {option}, or set SMSL_PASSPHRASE.",
        )
    try:
        typed = getpass.getpass(prompt, stream=sys.stderr)
    except EOFError:
        typed = ""
    if not typed:
        raise UsageError("the passphrase is empty", advice="Nothing was changed. Try again.")
    return typed.encode("utf-8", "surrogateescape")
