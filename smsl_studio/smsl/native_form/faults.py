"""The faults of a native text, collected while it is read."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.errors import Place, ReadError, TextFix
from smsl_studio.smsl.document.limits import MAX_FAULTS


class NativeFaultLimit(Exception):  # noqa: N818
    """Too many faults: the rest of the text is not reported."""


class Faults:
    """The faults of one text, in the order in which they are found."""

    def __init__(self, place_at: Callable[[int], Place]) -> None:
        self._place_at = place_at
        self._found: list[tuple[int, ReadError]] = []

    def __len__(self) -> int:
        return len(self._found)

    def add(
        self, at: int, end: int, sentence: str, advice: str, fix: TextFix | None = None
    ) -> None:
        """Add one fault of the characters from ``at`` to ``end``.

        A second fault at one of the last places is ignored, because it follows from the first.
        NativeFaultLimit if there are too many faults.
        """
        if any(at == known for known, _ in self._found[-3:]):
            return
        length = max(1, end - at)
        error = ReadError(sentence, self._place_at(at), advice, length=length, fix=fix)
        self._found.append((at, error))
        if len(self._found) >= MAX_FAULTS:
            raise NativeFaultLimit

    def error(self) -> ReadError | None:
        """Return all faults as one error, in the order of the text. None if there are no faults."""
        if not self._found:
            return None
        return ReadError.of([error for _, error in sorted(self._found, key=lambda item: item[0])])
