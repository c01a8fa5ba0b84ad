"""Quick fixes of faults and findings. Each is one undo step."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from smsl_studio.errors import ReadError, TextFix
from smsl_studio.inspection.repair import mend
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source.marks import fault_span, offset_of
from smsl_studio.studio.features.draw.source.sheet import TextSheet


@dataclass(frozen=True)
class TextRepair:
    """A fix that can be applied: its words, its shown line, and the function that applies it."""

    words: str
    line: int
    apply: Callable[[], object]


def of_faults(
    session: Session, sheet: TextSheet, faults: Sequence[ReadError]
) -> Iterator[TextRepair]:
    """The fixes of the faults of a broken text."""
    for fault in faults:
        if fault.fix is not None:
            line = sheet.where(fault_span(sheet, fault)[0])[0]
            yield TextRepair(fault.fix.words, line, _text_fix(session, fault.fix))


def of_findings(
    session: Session, sheet: TextSheet, findings: Sequence[Finding], file: str
) -> Iterator[TextRepair]:
    """The fixes of findings, as the findings panel applies them."""
    for finding in findings:
        fix = finding.fix
        if fix is not None:
            line = sheet.where(offset_of(sheet, finding.places_in(file)[0]))[0]
            yield TextRepair(
                fix.words, line, partial(session.edit, fix.words, partial(mend, finding=finding))
            )


def _text_fix(session: Session, fix: TextFix) -> Callable[[], None]:
    broken = session.broken

    def apply() -> None:
        """Write the fixed text, if the broken text has not changed since."""
        # The offsets of a fix hold for one text only.
        if broken is not None and session.broken is broken:
            text = broken.text[: fix.start] + fix.text + broken.text[fix.end :]
            session.write(fix.words, text, broken.file)

    return apply
