"""Finds names of states that are words, such as ``Idle``, but are read as facts by letters."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import chain

from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import StateBranch

MANY_LETTERS = 4
"""A name with at least so many letters counts as a word. Shorter ones, such as ``up``, may be
facts, unless they begin with a capital letter as ``Off`` does."""

Facts = dict[str, tuple[str, ...]]
"""For each state the values of its facts."""


def is_plain_word(branch: StateBranch, name: str) -> bool:
    """Return whether a name is a word or several, whose letters would mean nothing as facts.

    It has letters and spaces only, and neither the header nor an annotation speaks of facts.
    """
    shape = branch.shape
    said = shape.width != 1 or shape.written is not None or branch.subs or branch.notes.facts
    return not said and name.replace(" ", "").isalpha() and not name.startswith("State")


def read_by_letters(branch: StateBranch) -> tuple[str, ...]:
    """Return the states whose names are words but are read as facts, letter by letter.

    If nothing else in the SB shows facts, these are all plain words, if they have four letters or
    more, or a capital letter and small ones. Else
    a word is recognised by a letter that is a value of no other state: ``Patient ready`` beside
    ``State_01`` and ``State_11``. Other words may really be facts, such as ``abcd`` beside
    ``bacd``.
    """
    shape = branch.shape
    if not shape.width or shape.opaque:
        return ()
    plain = [name for name in branch.table if is_plain_word(branch, name)]
    if plain:
        return tuple(plain) if _are_surely_words(branch, plain) else ()
    words = [name for name in branch.table if _may_be_word(branch, name)]
    others = branch.table.keys() - set(words)
    seen = Counter(chain.from_iterable(enumerate(branch.facts(name)) for name in others or words))
    once = 0 if others else 1
    stems = {name: name.removesuffix(fact_string(name, shape.written)) for name in words}
    common = len(set(stems.values())) == 1 and not others
    found = []
    for name in words:
        new = sum(seen[at] <= once for at in enumerate(branch.facts(name)))
        if stems[name]:
            meant = common or (others and not new)
        else:
            meant = branch.num_facts < MANY_LETTERS or new * 2 <= branch.num_facts
        if not meant:
            found.append(name)
    return tuple(found)


def has_only_words(branch: StateBranch) -> bool:
    """Return whether every state is a plain word as ``read_by_letters`` has them, so that no name
    shows facts.

    In an SB whose names show facts this is found at its first state.
    """
    words = all(is_plain_word(branch, name) for name in branch.table)
    return words and bool(branch.table) and _are_surely_words(branch, branch.table)


def told_facts(branch: StateBranch) -> int:
    """Return how many facts of an SB people are told of; without states, NUM_FACTS of its header.

    Words, and names that cannot be cut, show no facts. A name that cannot be cut is one fact if a
    sub-SB expands it or if ``_facts`` says what it is.
    """
    if not branch.table:
        return branch.header.num_facts or 0
    if branch.shape.opaque:
        return int(bool(branch.subs) or branch.fact_note(0) is not None)
    return 0 if has_only_words(branch) else branch.num_facts


def is_read_by_letters(branch: StateBranch, name: str) -> bool:
    """Return whether a state is one of ``read_by_letters``.

    Most names cannot be words. For these the other states are not looked at, so the answer comes at
    once in a large SB, too.
    """
    may_be = is_plain_word(branch, name) or _may_be_word(branch, name)
    return may_be and name in read_by_letters(branch)


def carried(branch: StateBranch) -> Facts:
    """Return the facts of the states whose names really carry facts.

    Such a name is no word and has the usual length. The result is empty if the facts of the SB are
    in ``_states``.
    """
    shape = branch.shape
    if not shape.opaque:
        words = set(read_by_letters(branch)) if shape.width else branch.table.keys()
        return {name: branch.facts(name) for name in branch.table if name not in words}
    texts = {name: fact_string(name, shape.written) for name in branch.table}
    misfits = set(shape.misfits)
    fitting = {name: text for name, text in texts.items()
               if name not in misfits and text != name}  # fmt: skip
    number = shape.written or len(next(iter(fitting.values()), ""))
    wide = len(next(iter(fitting.values()), "")) // max(number, 1)
    return {name: tuple(text[at : at + wide] for at in range(0, len(text), wide))
            for name, text in fitting.items() if wide and len(text) == wide * number}  # fmt: skip


def _are_surely_words(branch: StateBranch, names: Iterable[str]) -> bool:
    """Whether plain words of an SB are too long to be facts, or written as words are."""
    capital = all(one[:1].isupper() and one[1:].replace(" ", "").islower() for one in names)
    return branch.num_facts >= MANY_LETTERS or capital


def _may_be_word(branch: StateBranch, name: str) -> bool:
    """Whether a name has letters only where it is cut, and one before the cut if there is any."""
    if branch.shape.width != 1 or name.startswith("State") or "_" in name:
        return False
    text = fact_string(name, branch.shape.written)
    before = name.removesuffix(text)[-1:]
    return text.isalpha() and (not before or before.isalpha())
