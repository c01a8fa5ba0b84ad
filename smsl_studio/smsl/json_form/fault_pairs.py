"""Merges two faults that are one: a wrong character counts as an extra and as a missing one."""

from __future__ import annotations

from smsl_studio.errors import TextFix
from smsl_studio.smsl.json_form.tokens import COMMENT, JsonFault


def merged(faults: list[JsonFault], text: str) -> list[JsonFault]:
    """Return the faults in the order of the text, with pairs merged.

    A removal and an insertion at the same place are one repair: a replacement.
    """
    coming: dict[int, int] = {}
    for index, fault in enumerate(faults):
        if fault.fix and fault.fix.start == fault.fix.end:
            coming.setdefault(fault.fix.start, index)
    kept: list[JsonFault | None] = list(faults)
    for index, fault in enumerate(faults):
        fix = fault.fix
        if fix is None or fix.text or fix.start == fix.end or fault.sentence == COMMENT:
            continue
        first = _first_of_run(text, fix)
        found = next((at for at in (fix.start, fix.end, first) if at in coming), None)
        if found is None:
            continue
        other = coming.pop(found)
        partner = kept[other]
        if partner is None or partner.fix is None:
            continue
        begin = first if found == first else fix.start
        start, end = min(fault.at, partner.at), max(_end(fault), _end(partner))
        words = TextFix(
            f"Write {''.join(partner.fix.text.split())}",
            begin,
            begin + fix.end - fix.start,
            partner.fix.text,
        )
        kept[other] = JsonFault(start, end - start, partner.sentence, partner.advice, words)
        kept[index] = None
    return sorted((one for one in kept if one is not None), key=lambda one: one.at)


def _first_of_run(text: str, fix: TextFix) -> int:
    """Return the first offset of the run of equal characters with the removed one. Any of them may
    go.
    """
    at = fix.start
    if fix.end == at + 1:
        while at > 0 and text[at - 1] == text[fix.start]:
            at -= 1
    return at


def _end(fault: JsonFault) -> int:
    return fault.at + fault.length
