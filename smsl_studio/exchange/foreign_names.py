"""Names of other programs as names of SMSL: none is empty, skipped, too long or taken."""

from __future__ import annotations

from smsl_studio.blueprint.names import FreeNames
from smsl_studio.blueprint.reading import HEADER
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.smsl.document.limits import MAX_NAME

_SHOWN = 200


class ForeignNames:
    """The names of elements of one kind that stand side by side, such as the states of one SB."""

    def __init__(self, kind: str, findings: ExchangeFindings) -> None:
        self._kind, self._findings = kind, findings
        self._free = FreeNames((HEADER,))

    def of(self, name: str, place: tuple[int, int] = (0, 0)) -> str:
        """Return a name of SMSL for a name of another program. A changed one is told."""
        wanted = name[:MAX_NAME]
        if wanted.startswith("_"):
            wanted = wanted.lstrip("_")
        taken = self._free.take(wanted or self._kind)
        if taken != name:
            words = f"The {self._kind} {name[:_SHOWN]!r} is called {taken!r} in the blueprint."
            self._findings.add("name", taken, words, place)
        return taken
