"""The limits of one file in any form, so that no file can exhaust time, memory or stack.

The limits are the same for the three forms. They are checked early, and the error has the place
where a limit is exceeded. Hanoi with ten disks (59,049 states, 177,144 operations, 9.6 MB) uses
half of them.
"""

from __future__ import annotations

from math import isfinite

LARGEST_FILE = 1 << 25
"""The largest number of bytes that are read: three times the largest file that was drawn."""

MAX_CHARACTERS = LARGEST_FILE
MAX_VALUES = 500_000
"""The largest number of names and values: members of maps and elements of lists at any depth."""

FREE_VALUES = 20_000
CHARACTERS_A_VALUE = 10
"""Above the free ones, a text needs this number of characters for each name or value.

Texts that people write have 15 to 40, with the indentation. The number of values costs time. So a
short text with very many values is refused before they are made.
"""

MAX_BRANCHES = 4000
"""The largest number of SBs of a blueprint, with imported ones: a hundred times what people
draw.
"""

MAX_NAME = 10_000
"""The largest number of characters of a name, which is drawn, listed and searched in many
places.
"""

MAX_DEPTH = 64
MAX_DIGITS = 4000
MAX_FAULTS = 100
"""The largest number of faults of one text that are reported. Nobody repairs more at once."""

TOO_DEEP = (
    f"nested deeper than {MAX_DEPTH} levels",
    "SMSL needs three levels and a few for annotations.",
)
"""The sentence and the advice."""

TOO_MANY_BRANCHES = (
    f"a blueprint has at most {MAX_BRANCHES:,} State Branches",
    "Split it into several blueprints.",
)


TOO_LONG = (
    f"the file is larger than {MAX_CHARACTERS >> 20} million characters",
    "Split it into several files, and import them.",
)


def most_values(text: str) -> int:
    """Return the largest number of names and values in a text of this length."""
    return min(MAX_VALUES, FREE_VALUES + len(text) // CHARACTERS_A_VALUE)


def too_many_values(text: str) -> tuple[str, str]:
    """Return the sentence and the advice for a text with too many names and values."""
    most = most_values(text)
    if most == MAX_VALUES:
        words = f"more than {most:,} names and values stand in one file"
        return words, "Split it into several files, and import them."
    words = f"more than {most:,} names and values stand in {len(text):,} characters"
    return words, "Write fewer of them; a name that says what it means is longer."


def too_large(number: str) -> bool:
    """Return whether a number has too many digits or too large an exponent."""
    if number.lstrip("-").isdecimal():
        return len(number) > MAX_DIGITS
    return len(number) > MAX_DIGITS or not isfinite(float(number))
