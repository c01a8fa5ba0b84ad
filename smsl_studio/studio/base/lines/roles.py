"""The line for the roles of the people who must answer, one role for each person.

An empty role means that anybody may answer.
"""

from __future__ import annotations

from typing import Any

from smsl_studio.studio.base.lines.text import ListLine

ANYBODY = "anybody"


class RolesLine(ListLine):
    """A list of roles. The same role twice stands for two people."""

    def __init__(self, words: str, tip: str, hint: str) -> None:
        super().__init__(words, tip, hint, once=False)

    def text_of(self, value: Any) -> str:
        """The roles, separated by commas; an empty role is shown as "anybody"."""
        return super().text_of([role or ANYBODY for role in value])

    def value_of(self, text: str) -> Any:
        """The typed roles; "anybody" becomes the empty text."""
        roles = super().value_of(text)
        return roles and ["" if role.casefold() == ANYBODY else role for role in roles]
