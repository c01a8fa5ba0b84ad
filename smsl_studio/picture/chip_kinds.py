"""How the chip of a fact is painted: filled, outlined, or as one of several values."""

from __future__ import annotations

from smsl_studio.blueprint.model import StateBranch

ON, OFF, VALUE = "on", "off", "value"


def chip_kind(branch: StateBranch, digit: int, value: str) -> str:
    """Return ``on`` (filled), ``off`` (outlined), or ``value`` if there are several values.

    A failure value is ``value``. It does not count as one of several values, so the other values
    can still be on or off. The value that ``_facts`` declares as on is always ``on``.
    """
    note = branch.fact_note(digit)
    if note is not None and value in note.failure:
        return VALUE
    declared = note is not None and note.on is not None
    seen = set(branch.alphabet[digit]) if digit < len(branch.alphabet) else set()
    values = seen.difference(note.failure if note is not None else ())
    binary = values <= {"0", "1"} or digit in branch.subs
    if (binary or declared) and value == branch.on_value(digit):
        return ON
    return OFF if binary or (declared and len(values) <= 2) else VALUE
