"""Two halves of one fault: a wrong character is one too many, and one that is missing."""

from __future__ import annotations

from smsl_studio.errors import TextFix
from smsl_studio.smsl.json_form.tokens import Fault


def merged(faults: list[Fault]) -> list[Fault]:
    """The faults in the order of the text, those that are one put together.

    What should go and what should come at the same place is one repair: write this, not that.
    """
    coming: dict[int, int] = {}
    for index, fault in enumerate(faults):
        if fault.fix and fault.fix.start == fault.fix.end:
            coming.setdefault(fault.fix.start, index)
    kept: list[Fault | None] = list(faults)
    for index, fault in enumerate(faults):
        fix = fault.fix
        if fix is None or fix.text or fix.start == fix.end:
            continue
        other = coming.pop(fix.start, None)
        if other is None:
            other = coming.pop(fix.end, None)
        if other is None or (partner := kept[other]) is None or partner.fix is None:
            continue
        start, end = min(fault.at, partner.at), max(_end(fault), _end(partner))
        words = TextFix(f"Write {partner.fix.text}", fix.start, fix.end, partner.fix.text)
        kept[other] = Fault(start, end - start, partner.sentence, partner.advice, words)
        kept[index] = None
    return sorted((one for one in kept if one is not None), key=lambda one: one.at)


def _end(fault: Fault) -> int:
    return fault.at + fault.length
