"""The passphrases of the environment, while a command runs: only the command has them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

VARIABLE, NEW_VARIABLE = "SMSL_PASSPHRASE", "SMSL_NEW_PASSPHRASE"


class Secrets:
    """The passphrases that stood in the environment. Only the options of one command hold this
    object, and no module does. So it is gone when the command ends."""

    def __init__(self, words: Mapping[str, str]) -> None:
        self._words = words

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(self._words)})"

    def given(self, variable: str) -> bytes:
        """Return the passphrase that stood in a variable, empty if it was not set."""
        return self._words.get(variable, "").encode("utf-8", "surrogateescape")


@contextmanager
def secrets_apart() -> Iterator[Secrets]:
    """Take the passphrases out of the environment while a command runs.

    So code of plugins that runs in this process, and every program that it starts, has an
    environment without them. They are put back at the end, for a program that calls a command.
    """
    names = (VARIABLE, NEW_VARIABLE)
    words = {name: os.environ.pop(name) for name in names if name in os.environ}
    try:
        yield Secrets(words)
    finally:
        os.environ.update(words)
