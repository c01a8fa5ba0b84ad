"""What leads back: in procedures that can be undone, an edge without its way back is a mistake.

``Op_1b`` from a to b is undone by ``Op_1a`` from b to a. How an edge is undone is learnt from edges
like it: the same operation with the same change first, then operations whose names differ only in
the values and the facts that change, then the operation with any change.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

from smsl_studio.generate.examples.fact_names import key_words
from smsl_studio.generate.examples.family import fine_words_of
from smsl_studio.generate.examples.table import Example, ExampleTable, Values
from smsl_studio.stop import heed

Key = tuple[object, ...]
_DOUBT = 0.2
_FEWEST = 2
_NEW, _OLD, _FACT = "<new", "<old", "<fact"


@dataclass
class _Likes:
    """Edges that are alike: their number, and how many of them are undone by what."""

    total: int
    undone: dict[Key, int]


class Reversals:
    """How the edges of a table are undone. It is learnt once, and asked of repaired tables too."""

    def __init__(self, table: ExampleTable) -> None:
        self._words = {name: fine_words_of(name) for name in table.edges}
        self._known = {words: name for name, words in self._words.items()}
        self._fact_words = key_words(table)
        self._likes: dict[Key, _Likes] = defaultdict(lambda: _Likes(0, defaultdict(int)))
        back = backward(table)
        for edge in table.all_edges():
            if edge.source != edge.target:
                heed()
                ways = back.get((edge.target, edge.source), ())
                for level, key in self._keys(edge):
                    likes = self._likes[key]
                    likes.total += 1
                    for way in ways:
                        likes.undone[self._way(level, way, edge)] += 1

    def expected(
        self, edge: Example, back: Mapping[tuple[Values, Values], tuple[str, ...]]
    ) -> set[str]:
        """Return the operations that are expected to undo an edge. Empty if nothing is known."""
        ways = back.get((edge.target, edge.source), ())
        for level, key in self._keys(edge):
            likes = self._likes.get(key)
            if likes is None:
                continue
            own = {self._way(level, way, edge) for way in ways}
            others = likes.total - 1
            if others < _FEWEST:
                continue
            found = set()
            for way, count in likes.undone.items():
                agreeing = count - (way in own)
                if agreeing >= max(_FEWEST, others - max(1, int(_DOUBT * others))):
                    name = self._name(level, way, edge)
                    if name is not None:
                        found.add(name)
            if found or level == 0:
                return found
        return set()

    def guessed(self, edge: Example) -> set[str]:
        """Return the operations that undo any edge like this one."""
        names = {
            self._name(level, way, edge)
            for level, key in self._keys(edge)
            if key in self._likes
            for way in self._likes[key].undone
        }
        return {name for name in names if name is not None}

    def effect(self, edge: Example) -> Key:
        """Return what an edge does: its operation without the facts and values that it changes, and
        the values it gives them."""
        new = tuple(edge.target[digit] for digit in _changed(edge))
        return (self._pattern(edge.operation, edge), new)

    def _keys(self, edge: Example) -> tuple[tuple[int, Key], ...]:
        changed = _changed(edge)
        exact = tuple((digit, edge.source[digit], edge.target[digit]) for digit in changed)
        pattern = self._pattern(edge.operation, edge)
        return (
            (0, (0, edge.operation, exact)),
            (1, (1, pattern, changed)),
            (2, (2, pattern, len(changed))),
            (3, (3, edge.operation)),
        )

    def _way(self, level: int, way: str, edge: Example) -> Key:
        return self._pattern(way, edge) if level in (1, 2) else (way,)

    def _name(self, level: int, way: Key, edge: Example) -> str | None:
        if level in (0, 3):
            return str(way[0])
        changed = _changed(edge)
        words = []
        for one in way:
            word = str(one)
            if word.startswith((_NEW, _OLD, _FACT)) and word.endswith(">"):
                kind, number = word[:-1].split(" ")
                digit = changed[int(number)]
                if kind == _FACT:
                    word = self._fact_words.get(digit, "")
                else:
                    word = (edge.target if kind == _NEW else edge.source)[digit]
            words.append(word)
        return self._known.get(tuple(words))

    def _pattern(self, operation: str, edge: Example) -> Key:
        """Return the words of a name with marks for what an edge changes."""
        changed = _changed(edge)
        marks: dict[str, str] = {}
        for number, digit in enumerate(changed):
            word = self._fact_words.get(digit)
            if word is not None:
                marks.setdefault(word, f"{_FACT} {number}>")
        facts = dict(marks)
        for number, digit in enumerate(changed):
            marks.setdefault(edge.target[digit], f"{_NEW} {number}>")
            marks.setdefault(edge.source[digit], f"{_OLD} {number}>")
        words = self._words.get(operation) or fine_words_of(operation)
        found: list[str] = []
        for word in words:
            mark = marks.get(word, word)
            if word in facts and facts[word] in found:
                # The first such word names the fact, another one a value.
                mark = self._value_mark(word, edge, changed) or mark
            found.append(mark)
        return tuple(found)

    def _value_mark(self, word: str, edge: Example, changed: tuple[int, ...]) -> str | None:
        for number, digit in enumerate(changed):
            if edge.target[digit] == word:
                return f"{_NEW} {number}>"
            if edge.source[digit] == word:
                return f"{_OLD} {number}>"
        return None


def backward(table: ExampleTable) -> dict[tuple[Values, Values], tuple[str, ...]]:
    """Return the operations between two states."""
    found: dict[tuple[Values, Values], tuple[str, ...]] = {}
    for edge in table.all_edges():
        heed()
        key = edge.source, edge.target
        found[key] = (*found.get(key, ()), edge.operation)
    return found


def _changed(edge: Example) -> tuple[int, ...]:
    return tuple(d for d, value in enumerate(edge.source) if edge.target[d] != value)
