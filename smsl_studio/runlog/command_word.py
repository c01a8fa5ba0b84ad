"""The properties of a command that a reader of a log needs. ``dispatch`` has the table of
commands.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol


class CommandWord(Protocol):
    """A command as a log shows it."""

    @property
    def word(self) -> str:
        """The word of the command."""

    @property
    def refused(self) -> Mapping[str, str]:
        """The run states in which the command is never carried out, each with the reason."""

    @property
    def owes(self) -> str:
        """The event that must follow if the command was carried out, before the next command and at
        the same time. Empty if there is none.
        """

    @property
    def explains(self) -> tuple[str, ...]:
        """The events that are attributed to the person who gave the command."""

    @property
    def must_name(self) -> bool:
        """Whether the command always names an operation if it is carried out."""

    @property
    def may_name(self) -> bool:
        """Whether the command may name an operation."""

    @property
    def has_value(self) -> bool:
        """Whether the command has a value."""

    def told(self, address: str, value: str) -> str:
        """Return the sentence of an account, or the empty text if there is none for this value."""


CommandWords = Mapping[str, CommandWord]
"""The commands by their words."""
