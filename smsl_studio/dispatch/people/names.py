"""Who is who: one person stays one person, however the name is typed."""

from __future__ import annotations

import unicodedata


def same_name(text: str) -> str:
    """What two spellings of one name or role have in common.

    Case, the white space around and between the words, characters nobody sees and the form in
    which accents are stored make no other person.
    """
    plain = unicodedata.normalize("NFKC", text)
    seen = "".join(char for char in plain if unicodedata.category(char) != "Cf")
    return " ".join(unicodedata.normalize("NFKC", seen.casefold()).split())
