"""Names for the facts, such that the words in the names of operations name them.

``Op_1b`` and ``Op_1c`` change the first digit and ``Op_2b`` the second: then 1 and 2 are the names
of these facts, and a rule can write ``{x}`` for both.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

from smsl_studio.generate.examples.atoms import digit_name
from smsl_studio.generate.examples.family import fine_words_of, words_of
from smsl_studio.generate.examples.table import ExampleTable
from smsl_studio.stop import heed

Key = tuple[str, ...]
_MOST_NAME = 40


def fact_names(table: ExampleTable) -> tuple[str, ...]:
    """Return a name for each fact: its plain name, or the words that name it in operations, or
    its digit."""
    labels = _labels(table)
    keys = _keys(table)
    if not keys:
        return labels
    if all(table.labels[digit] for digit in keys) and _names_in(labels, keys):
        return labels
    names = list(labels)
    for digit, key in keys.items():
        text = "_".join(key)
        names[digit] = text if not text[:1].isdigit() else f"fact{text}"
    distinct = len(set(names)) == len(names)
    return tuple(names) if distinct and all(_usable(one) for one in names) else labels


def _labels(table: ExampleTable) -> tuple[str, ...]:
    labels = tuple(
        label if _usable(label) else digit_name(digit) for digit, label in enumerate(table.labels)
    )
    if len(set(labels)) < len(labels):
        return tuple(map(digit_name, range(len(labels))))
    return labels


def _usable(name: str) -> bool:
    return (
        0 < len(name) <= _MOST_NAME
        and not name.isdecimal()
        and name.isprintable()
        and not any(sign in name for sign in "{}")
    )


def _names_in(labels: Sequence[str], keys: Mapping[int, Key]) -> bool:
    """Return whether the plain names are made of the keys and equal words around them."""
    for digit, key in keys.items():
        text = labels[digit]
        if len(key) != 1 or key[0] not in text:
            return False
    frames = {tuple(labels[digit].split(key[0], 1)) for digit, key in keys.items()}
    return len(frames) == 1


def _keys(table: ExampleTable) -> dict[int, Key]:
    """Return the words that name a fact, by its digit."""
    changed = {operation: _changed(own.items()) for operation, own in table.edges.items()}
    found: dict[int, Key] = {}
    for cut in (words_of, fine_words_of):
        clusters: dict[tuple[object, ...], list[str]] = defaultdict(list)
        for operation, digits in changed.items():
            if digits:
                words = cut(operation)
                clusters[tuple(w if not w.isalnum() else None for w in words)].append(operation)
        for members in sorted(clusters.values(), key=lambda one: -len(one)):
            own = _cluster_keys({name: cut(name) for name in members}, changed)
            for digit, key in own.items():
                if digit not in found and key not in found.values():
                    found[digit] = key
        if found:
            return found
    return found


def _cluster_keys(
    words: Mapping[str, tuple[str, ...]], changed: Mapping[str, frozenset[int]]
) -> dict[int, Key]:
    """Return the keys that one or two places of names of equal form give."""
    columns = list(zip(*words.values(), strict=True))
    varied = [at for at, column in enumerate(columns) if len(set(column)) > 1]
    choices = [(at,) for at in varied] + list(combinations(varied, 2))
    best: dict[int, Key] = {}
    for places in choices:
        heed()
        digits: dict[Key, frozenset[int]] = {}
        for name, own in words.items():
            key = tuple(own[at] for at in places)
            digits[key] = digits.get(key, changed[name]) & changed[name]
        taken = [next(iter(own)) for own in digits.values() if len(own) == 1]
        if len(taken) == len(digits) == len(set(taken)) and len(taken) > len(best):
            best = {next(iter(own)): key for key, own in digits.items()}
    return best if len(best) > 1 else {}


def _changed(edges: Iterable[tuple[Sequence[str], Sequence[str]]]) -> frozenset[int]:
    """Return the facts that most of the edges that change something change."""
    counts: dict[int, int] = defaultdict(int)
    total = 0
    for source, target in edges:
        heed()
        own = [digit for digit, value in enumerate(source) if target[digit] != value]
        total += bool(own)
        for digit in own:
            counts[digit] += 1
    return frozenset(digit for digit, count in counts.items() if 5 * count >= 3 * total)


def key_words(table: ExampleTable) -> dict[int, str]:
    """Return the one word that names a fact in operations, for each fact that has one."""
    return {digit: key[0] for digit, key in _keys(table).items() if len(key) == 1}
