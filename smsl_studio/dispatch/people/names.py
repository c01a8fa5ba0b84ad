"""Who is who: one person stays one person, however the name is typed."""

from __future__ import annotations

import unicodedata

UNSEEN = frozenset("\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800")
"""What nobody sees though it counts as a letter, a mark or a symbol."""

NAMELESS = frozenset(("a person", "script"))
"""Who speaks where nobody said a name: enough to answer alone, not to be told from another."""


def same_name(text: str) -> str:
    """What two spellings of one name or role have in common.

    Case, the white space around and between the words, characters nobody sees and the form in
    which accents are stored make no other person.
    """
    plain = unicodedata.normalize("NFKC", text)
    seen = "".join(char for char in plain if not _unseen(char))
    return " ".join(unicodedata.normalize("NFKC", seen.casefold()).split())


def _unseen(char: str) -> bool:
    """Format and control characters, fillers, and what only chooses how another one is drawn."""
    if char in UNSEEN or unicodedata.name(char, "").startswith("VARIATION SELECTOR"):
        return True
    return unicodedata.category(char) in ("Cf", "Cc") and not char.isspace()
