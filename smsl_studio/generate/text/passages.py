"""Finds the passages of many texts that fit a question best (BM25). The same texts give the same
passages."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec

from smsl_studio.errors import UsageError
from smsl_studio.generate.text.expert_text import ExpertText, SourceLine
from smsl_studio.stop import heed

WINDOW = 8
"""The lines of a passage. Each passage begins in the middle of the one before."""
MOST_PASSAGES = 40
"""So many passages are given to who answers."""
MOST_WORDS = 400
"""A question has at most so many words."""
_WORD = re.compile(r"[^\W_]{2,}")


@dataclass(frozen=True)
class Passage:
    """Some lines of a text that follow each other, and how well they fit (more is better)."""

    text: ExpertText
    lines: tuple[SourceLine, ...]
    score: float


class PassageIndex:
    """Texts that can be searched. UsageError if bm25s is not installed."""

    def __init__(self, texts: Sequence[ExpertText]) -> None:
        if find_spec("bm25s") is None:
            raise UsageError(
                "a folder is searched with bm25s, which is not installed",
                advice="Install it with: pip install smsl-studio[text], or name the files.",
            )
        import bm25s

        self._texts = texts
        self._places = [
            (number, begin) for number, text in enumerate(texts) for begin in _begins(text)
        ]
        self._engine = bm25s.BM25()
        self._known: dict[str, int] = {}
        tokens = []
        for number, begin in self._places:
            heed()
            lines = texts[number].lines[begin : begin + WINDOW]
            tokens.append([self._number(word) for line in lines for word in _words(line.text)])
        # One more passage, of a word that no question has: an index of no words at all has no form.
        tokens.append([self._number("")])
        self._engine.index((tokens, self._known), show_progress=False)

    def best(self, question: Iterable[str], most: int = MOST_PASSAGES) -> list[Passage]:
        """Return the passages that fit the words of a question, the best first. Passages that
        overlap better ones are left out. There may be none."""
        words: dict[str, None] = {}
        for text in question:
            for word in _words(text):
                if len(words) < MOST_WORDS and word in self._known:
                    words.setdefault(word)
        if not words:
            return []
        asked = [self._known[word] for word in words]
        scores = self._engine.get_scores_from_ids(asked)[: len(self._places)]
        order = sorted(range(len(self._places)), key=lambda at: (-float(scores[at]), at))
        found: list[Passage] = []
        taken: set[tuple[int, int]] = set()
        for at in order:
            number, begin = self._places[at]
            if scores[at] <= 0 or len(found) >= most:
                break
            if any((number, begin + shift) in taken for shift in (-WINDOW // 2, WINDOW // 2)):
                continue
            taken.add((number, begin))
            lines = self._texts[number].lines[begin : begin + WINDOW]
            found.append(Passage(self._texts[number], lines, float(scores[at])))
        return found

    def _number(self, word: str) -> int:
        return self._known.setdefault(word, len(self._known))


def _begins(text: ExpertText) -> Iterator[int]:
    yield from range(0, max(1, len(text.lines) - WINDOW // 2), WINDOW // 2)


def _words(text: str) -> list[str]:
    return _WORD.findall(text.casefold())
