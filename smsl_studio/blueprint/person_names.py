"""Names of persons: different spellings of a name mean the same person."""

from __future__ import annotations

import unicodedata

UNSEEN = frozenset("\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800")
"""Characters that are invisible although they count as letters, marks or symbols."""

INVISIBLE = frozenset(("Cc", "Cf", "Zl", "Zp", "Zs"))
"""The categories of control and format characters and of white space."""

NAMELESS = frozenset(("aperson", "script"))
"""The names of people who gave no name (see ``same_name``). They may answer alone, but cannot be
told from each other.
"""


def same_name(text: str) -> str:
    """Return the form that all spellings of one name or role share.

    Case, white space around and between words, invisible characters and the encoding of accents do
    not matter.
    """
    plain = unicodedata.normalize("NFKC", text)
    seen = "".join(char for char in plain if not _unseen(char))
    return unicodedata.normalize("NFKC", seen.casefold())


def _unseen(char: str) -> bool:
    """Return whether a character is invisible: white space, format and control characters, fillers,
    and variation selectors.
    """
    if char in UNSEEN or unicodedata.name(char, "").startswith("VARIATION SELECTOR"):
        return True
    return unicodedata.category(char) in INVISIBLE
