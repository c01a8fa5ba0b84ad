"""The text of a state whose node has no room for its name and its facts."""

from __future__ import annotations

from collections import Counter
from functools import cached_property

from smsl_studio.blueprint.facts import fact_string, fact_strings
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.plain_words import read_by_letters

MOST_SHOWN = 64
"""Of a name with more facts than this, the beginning and the end are shown."""


class ShortForms:
    """The short forms of the states of one SB.

    A name that carries facts, such as ``State_110``, is shortened to them. A name that is a word,
    such as ``Homing``, has no short form, whatever the facts of the state are: people know the
    state by its name. Where two names carry the same facts, such as ``State_110`` and ``110``,
    neither is shortened, because both would look alike. All texts of a state come from its name.
    """

    def __init__(self, branch: StateBranch) -> None:
        self._branch = branch

    def of(self, name: str) -> str:
        """Return the short form of a state, which is its name if it has none."""
        branch, shape = self._branch, self._branch.shape
        if shape.opaque or (self._may_be_word(name) and name in self._words):
            return name
        if fact_string(name, shape.written) in self._shared:
            return name
        facts = branch.facts(name)
        if not shape.width and "".join(facts) != fact_string(name, shape.written):
            return name
        if len(facts) > MOST_SHOWN:  # the beginning and the end distinguish states
            facts = (*facts[: MOST_SHOWN // 2], "…", *facts[-MOST_SHOWN // 2 :])
        return "".join(facts) if shape.width else " ".join(facts)

    @staticmethod
    def _may_be_word(name: str) -> bool:
        """Return whether the other states must be looked at; in a large SB that takes time."""
        return "_" not in name and not name.startswith("State")

    @cached_property
    def _shared(self) -> frozenset[str]:
        """The texts with the facts that more than one name has."""
        texts = fact_strings(self._branch.table, self._branch.shape.written)
        if len(set(texts)) == len(texts):
            return frozenset()
        return frozenset(text for text, count in Counter(texts).items() if count > 1)

    @cached_property
    def _words(self) -> frozenset[str]:
        """The names that are words but are read as facts by letters."""
        return frozenset(read_by_letters(self._branch))
