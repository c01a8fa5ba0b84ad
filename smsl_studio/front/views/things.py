"""Which things of a world a fact is about. Nothing is declared for that: names tell it.

A thing belongs to the facts whose sources begin with its name: ``disk_1`` to the fact that
``disk_1_peg`` tells. A thing without such sources belongs to the facts that the operations with its
name change: ``sheep`` to what ``move_sheep_to_boat`` changes. A thing whose operations change all
facts, such as a table on which everything stands, belongs to none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint

Facts = frozenset[FactKey]


def facts_of_things(
    blueprint: Blueprint, sources: Iterable[tuple[FactKey, str]], things: Iterable[str]
) -> dict[str, Facts]:
    """Return the facts of each thing by its name; things without facts are left out.

    ``sources`` are the names of the sources of facts.
    """
    told = [(key, f"{'_'.join(_words(name))}_") for key, name in sources]
    changed = _changed_by_words(blueprint)
    every = {key for keys in changed.values() for key in keys}
    found = {}
    for thing in dict.fromkeys(things):
        words = _words(thing)
        start = f"{'_'.join(words)}_"
        own = {key for key, name in told if name.startswith(start)}
        if not own and words:
            # "landmark 3" is one of the landmarks.
            named = [word for word in words if not word.isdigit()]
            sets = [changed.get(word, changed.get(f"{word}s", frozenset())) for word in named]
            own = set.intersection(*map(set, sets)) if sets else set()
            own = own if own != every else set()
        if own:
            found[thing] = frozenset(own)
    return found


def changes_of(blueprint: Blueprint, branch: str, state: str, target: str) -> Facts:
    """Return the facts in which two states of an SB differ."""
    own = blueprint[branch]
    pairs = zip(own.facts(state), own.facts(target), strict=False)
    return frozenset((branch, digit) for digit, (old, new) in enumerate(pairs) if old != new)


def _changed_by_words(blueprint: Blueprint) -> dict[str, Facts]:
    """Return the facts that operations change, by each word of their names."""
    found: dict[str, set[FactKey]] = {}
    for branch in blueprint:
        for state, edges in branch.table.items():
            for operation, target in edges.items():
                changed = changes_of(blueprint, branch.name, state, target)
                for word in _words(operation):
                    found.setdefault(word, set()).update(changed)
    return {word: frozenset(keys) for word, keys in found.items()}


def _words(name: str) -> tuple[str, ...]:
    """Return the words of a name, small: those of ``Op_DigitizeLandmarks`` are three."""
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name)
    return tuple(word.lower() for word in re.split(r"[\W_]+", apart) if word)
