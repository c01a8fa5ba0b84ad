"""The passphrases of the environment, while a command runs: the command reads them here."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator

VARIABLE, NEW_VARIABLE = "SMSL_PASSPHRASE", "SMSL_NEW_PASSPHRASE"

_taken: dict[str, str] = {}


@contextlib.contextmanager
def passphrases_apart() -> Iterator[None]:
    """Take the passphrases out of the environment while a command runs.

    So code of plugins that runs in this process, and every program that it starts, has an
    environment without them. They are put back at the end, for a program that calls a command.
    """
    for name in (VARIABLE, NEW_VARIABLE):
        if name in os.environ:
            _taken[name] = os.environ.pop(name)
    try:
        yield
    finally:
        os.environ.update(_taken)
        _taken.clear()


def given_passphrase(variable: str) -> bytes:
    """Return what a variable of the environment has as a passphrase, empty if it is not set."""
    words = _taken.get(variable) or os.environ.get(variable, "")
    return words.encode("utf-8", "surrogateescape")
