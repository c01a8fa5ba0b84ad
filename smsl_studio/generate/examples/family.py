"""Operations whose names differ in some words only, as one rule with parameters writes them."""

from __future__ import annotations

import itertools
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.stop import heed

PARAMETERS = ("x", "y", "z")
_COARSE = re.compile(r"[A-Z]+(?![^\W\d_A-Z])|[A-Z]?[^\W\d_A-Z]+|[^\W\d_]+|\d+|[\W_]")
_FINE = re.compile(r"[A-Z]?[^\W\d_A-Z]+|[^\W\d_]|\d|[\W_]")
_MOST_VARIED = 6
_LARGEST = 4096
Words = tuple[str, ...]


@dataclass(frozen=True)
class Family:
    """One rule's operations. ``choices`` has the values of each parameter.

    ``operations`` has their names in the order in which ``for`` makes them, which is that of the
    product of the choices. A name that no edge has is one, too.
    """

    pattern: str
    choices: Mapping[str, tuple[str, ...]]
    operations: tuple[str, ...]

    @property
    def given(self) -> list[tuple[str, ...]]:
        """The values of the parameters of each operation."""
        return list(itertools.product(*self.choices.values()))

    def fact_terms(self, names: Sequence[str]) -> dict[str, tuple[str, ...]]:
        """Return the patterns that name a fact in every operation, and the names."""
        return self._patterns(names)

    def value_terms(self, values: Sequence[str]) -> dict[str, tuple[str, ...]]:
        """Return the patterns that name a value in every operation, and the values."""
        return self._patterns(values)

    def _patterns(self, texts: Sequence[str]) -> dict[str, tuple[str, ...]]:
        known = set(texts)
        given = self.given
        found: dict[str, tuple[str, ...]] = {}
        if not self.choices:
            return found
        names = list(self.choices)
        for text in texts:
            for pattern in _holed(text, dict(zip(names, given[0], strict=True))):
                heed()
                made = tuple(_filled(pattern, names, one) for one in given)
                if pattern not in found and all(one in known for one in made):
                    found[pattern] = made
        return found


def single(operation: str) -> Family:
    """Return the family of one operation."""
    return Family(operation, {}, (operation,))


def families(operations: Iterable[str]) -> list[Family]:
    """Return the families with parameters that some names could be, the largest first."""
    found: dict[tuple[str, ...], Family] = {}
    names = list(operations)
    for cut in (_COARSE, _FINE):
        clusters: dict[tuple[object, ...], list[Words]] = defaultdict(list)
        for name in names:
            words = tuple(cut.findall(name))
            shape = tuple(word if not word.isalnum() else None for word in words)
            clusters[shape].append(words)
        for cluster in clusters.values():
            for family in _cluster_families(cluster):
                found.setdefault(family.operations, family)
    return sorted(found.values(), key=lambda one: (-len(one.operations), len(one.choices)))


def _cluster_families(cluster: Sequence[Words]) -> Iterator[Family]:
    places = [at for at, column in enumerate(zip(*cluster, strict=True)) if len(set(column)) > 1]
    if not places or len(places) > _MOST_VARIED:
        return
    most = min(len(places), len(PARAMETERS))
    for count in range(1, most + 1):
        for chosen in itertools.combinations(places, count):
            parts: dict[Words, list[Words]] = defaultdict(list)
            for words in cluster:
                fixed = tuple("" if at in chosen else word for at, word in enumerate(words))
                parts[fixed].append(words)
            for fixed, members in parts.items():
                heed()
                yield from _product(fixed, chosen, members)


def _product(fixed: Words, chosen: Sequence[int], members: Sequence[Words]) -> Iterator[Family]:
    """Give the family of some names, if they are at least half of its product."""
    choices = [tuple(sorted({words[at] for words in members})) for at in chosen]
    size = 1
    for own in choices:
        size *= len(own)
    if len(members) < 2 or size > 2 * len(members) or size > _LARGEST:
        return
    if any(len(own) < 2 for own in choices):
        return
    words = list(fixed)
    names = PARAMETERS[: len(chosen)]
    for name, at in zip(names, chosen, strict=True):
        words[at] = f"{{{name}}}"
    pattern = "".join(words)
    made = tuple(_filled(pattern, names, one) for one in itertools.product(*choices))
    yield Family(pattern, dict(zip(names, choices, strict=True)), made)


def without(family: Family, name: str, value: str) -> Family | None:
    """Return the family without one value of a parameter, None if too few are left."""
    choices = {
        key: tuple(one for one in own if key != name or one != value)
        for key, own in family.choices.items()
    }
    if len(choices[name]) < 2:
        return None
    made = tuple(
        _filled(family.pattern, list(choices), one) for one in itertools.product(*choices.values())
    )
    return Family(family.pattern, choices, made)


def words_of(name: str) -> Words:
    """Return the words of a name: letters, digits, or one other sign."""
    return tuple(_COARSE.findall(name))


def fine_words_of(name: str) -> Words:
    """Return the words of a name, with each digit and each capital as a word of its own."""
    return tuple(_FINE.findall(name))


def _holed(text: str, given: Mapping[str, str]) -> Iterator[str]:
    """Give the text with one or two parameters in the place of their values."""
    for name, value in given.items():
        for at in _places(text, value):
            before, after = text[:at], text[at + len(value) :]
            yield f"{before}{{{name}}}{after}"
            for other, second in given.items():
                if other != name:
                    for place in _places(after, second):
                        rest = after[place + len(second) :]
                        yield f"{before}{{{name}}}{after[:place]}{{{other}}}{rest}"


def _places(text: str, part: str) -> Iterator[int]:
    at = text.find(part)
    while at >= 0:
        yield at
        at = text.find(part, at + 1)


def _filled(pattern: str, names: Sequence[str], values: Sequence[str]) -> str:
    for name, value in zip(names, values, strict=True):
        pattern = pattern.replace(f"{{{name}}}", value)
    return pattern
