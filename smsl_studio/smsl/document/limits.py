"""How much one file may ask for, in any form, so that none exhausts time, memory or stack.

One budget for the three forms. It is asked before much is made of a text, and what goes beyond it
is refused at the place where it does. Hanoi with ten disks (59,049 states, 177,144 operations,
9.6 MB) takes half of it.
"""

from __future__ import annotations

from math import isfinite

LARGEST_FILE = 1 << 25
"""At most so many bytes of a file are read: three times the largest file that was drawn."""

MAX_CHARACTERS = LARGEST_FILE
MAX_VALUES = 500_000
"""So many names and values a file may hold: members of maps and elements of lists, of any depth."""

FREE_VALUES = 20_000
CHARACTERS_A_VALUE = 10
"""Beyond the free ones, a text needs so many characters for each name or value that it holds.

What people draw has 15 to 40, with the indentation. What costs time is the number of values, so a
text that is short and stands for very many is refused before they are made.
"""

MAX_BRANCHES = 4000
"""So many SBs a blueprint may have, imported ones too: a hundred times what people draw."""

MAX_NAME = 10_000
"""So many characters a name may have: it is drawn, listed and sought in many places."""

MAX_DEPTH = 64
MAX_DIGITS = 4000
MAX_FAULTS = 100
"""At most so many faults of one text are reported; nobody repairs more at once."""

TOO_DEEP = (
    f"nested deeper than {MAX_DEPTH} levels",
    "SMSL needs three levels and a few for annotations.",
)
"""What is told of it, and what to do."""

TOO_MANY_BRANCHES = (
    f"a blueprint has at most {MAX_BRANCHES:,} State Branches",
    "Split it into several blueprints.",
)


TOO_LONG = (
    f"the file is larger than {MAX_CHARACTERS >> 20} million characters",
    "Split it into several files, and import them.",
)


def most_values(text: str) -> int:
    """How many names and values a text of this length may hold."""
    return min(MAX_VALUES, FREE_VALUES + len(text) // CHARACTERS_A_VALUE)


def too_many_values(text: str) -> tuple[str, str]:
    """What is told of a text that holds more than it may, and what to do."""
    most = most_values(text)
    if most == MAX_VALUES:
        words = f"more than {most:,} names and values stand in one file"
        return words, "Split it into several files, and import them."
    words = f"more than {most:,} names and values stand in {len(text):,} characters"
    return words, "Write fewer of them; a name that says what it means is longer."


def too_large(number: str) -> bool:
    """Whether a number has more digits, or a larger exponent, than there is room for."""
    if number.lstrip("-").isdecimal():
        return len(number) > MAX_DIGITS
    return len(number) > MAX_DIGITS or not isfinite(float(number))
