"""Names for generated code: identifiers from titles, and one name for each thing."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable

LONGEST = 48
"""The largest number of characters of an identifier without the number that tells it apart."""


def package_name(stem: str) -> str:
    """Return the name of a package for a file: letters, digits and ``_``, ``dsfo_`` before a
    digit.

    >>> package_name("hanoi-2"), package_name("3 levels")
    ('hanoi_2', 'dsfo_3_levels')
    """
    name = re.sub(r"[^A-Za-z0-9_]", "_", stem) or "_"
    return f"dsfo_{name}" if name[0].isdigit() else name


def is_package_name(name: str) -> bool:
    """Return whether somebody may call a package so."""
    return re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]{0,199}", name) is not None


def snake(text: str, otherwise: str) -> str:
    """Return a text as an identifier in small letters. Nothing left of it: ``otherwise``.

    >>> snake("LandmarksPlanned", "operation"), snake("2 eyes", "fact"), snake("class", "sb")
    ('landmarks_planned', 'fact_2_eyes', 'class_')
    """
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", text)
    plain = re.sub(r"[^A-Za-z0-9]+", "_", parted).strip("_").lower()[:LONGEST].rstrip("_")
    if not plain:
        return otherwise
    if plain[0].isdigit():
        return f"{otherwise}_{plain}"
    return f"{plain}_" if keyword.iskeyword(plain) or keyword.issoftkeyword(plain) else plain


class Namer:
    """Gives each key one identifier, and no identifier twice. ``taken`` are given to nobody."""

    def __init__(self, otherwise: str, taken: Iterable[str] = ()) -> None:
        self._otherwise = otherwise
        self._taken = set(taken)
        self._given: dict[object, str] = {}

    def name(self, key: object, text: str) -> str:
        """Return the identifier of a key. It is made from a text when it is first asked for."""
        if key not in self._given:
            plain = snake(text, self._otherwise)
            name, number = plain, 1
            while name in self._taken:
                number += 1
                name = f"{plain}_{number}"
            self._taken.add(name)
            self._given[key] = name
        return self._given[key]
