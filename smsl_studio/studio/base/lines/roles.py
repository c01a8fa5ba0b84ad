"""The roles of those who must answer, one for each person; a role that is not said is anybody's."""

from __future__ import annotations

from typing import Any

from smsl_studio.studio.base.lines.text import ListLine

ANYBODY = "anybody"


class RolesLine(ListLine):
    """A role that is typed twice stands for two persons."""

    def __init__(self, words: str, tip: str, hint: str) -> None:
        super().__init__(words, tip, hint, once=False)

    def text_of(self, value: Any) -> str:
        """The roles with commas between them; one that is not said reads "anybody"."""
        return super().text_of([role or ANYBODY for role in value])

    def value_of(self, text: str) -> Any:
        """The roles as they are written; anybody becomes the empty text."""
        roles = super().value_of(text)
        return roles and ["" if role.casefold() == ANYBODY else role for role in roles]
