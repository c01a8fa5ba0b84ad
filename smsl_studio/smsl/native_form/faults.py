"""What is wrong with a text, gathered while parsing goes on."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.errors import Place, ReadError, TextFix
from smsl_studio.smsl.document.limits import MAX_FAULTS


class NativeFaultLimit(Exception):  # noqa: N818
    """Too many faults: what follows in the text is not worth reporting."""


class Faults:
    """The faults of one text, in the order in which they were met."""

    def __init__(self, place_at: Callable[[int], Place]) -> None:
        self._place_at = place_at
        self._found: list[tuple[int, ReadError]] = []

    def __len__(self) -> int:
        return len(self._found)

    def add(
        self, at: int, end: int, sentence: str, advice: str, fix: TextFix | None = None
    ) -> None:
        """One fault, of the characters from ``at`` to ``end``; a second at one place is an echo."""
        if any(at == known for known, _ in self._found[-3:]):
            return
        length = max(1, end - at)
        error = ReadError(sentence, self._place_at(at), advice, length=length, fix=fix)
        self._found.append((at, error))
        if len(self._found) >= MAX_FAULTS:
            raise NativeFaultLimit

    def error(self) -> ReadError | None:
        """All of them as one error, in the order of the text; None where there are none."""
        if not self._found:
            return None
        return ReadError.of([error for _, error in sorted(self._found, key=lambda item: item[0])])
