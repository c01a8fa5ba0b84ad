"""What a reader of a log must know of the commands; ``dispatch`` has the table of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol


class CommandWord(Protocol):
    """A command as it stands in a log."""

    @property
    def word(self) -> str:
        """The word of the command."""

    @property
    def refused(self) -> Mapping[str, str]:
        """The run states in which it is never carried out, each with the reason."""

    @property
    def owes(self) -> str:
        """The event that must follow where it was carried out, before anything else is commanded
        and before time goes on; empty where none must."""

    @property
    def explains(self) -> tuple[str, ...]:
        """The events that are told in the name of whoever commanded it."""

    @property
    def must_name(self) -> bool:
        """Whether it names an operation wherever it is carried out."""

    @property
    def may_name(self) -> bool:
        """Whether it may name one."""

    @property
    def has_value(self) -> bool:
        """Whether it has a value."""

    def told(self, address: str, value: str) -> str:
        """What an account says of it; empty where it has no words for such a value."""


CommandWords = Mapping[str, CommandWord]
"""Commands by their words."""
