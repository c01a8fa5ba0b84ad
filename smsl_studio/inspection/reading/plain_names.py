"""Names for a reader: titles instead of identifiers, and what facts mean instead of digits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.reading.sections import Untitled

UNTITLED = "A step without a title"
NOBODY = ("",)
BINARY = frozenset("01")
MOST_NAMED = 12
"""The largest number of things that one sentence lists."""


class PlainNames:
    """The words for the elements of a blueprint. Nothing is invented: a step without a title is
    called so.

    With ``identifiers`` the name in the file stands behind each title, for engineers.
    """

    def __init__(self, blueprint: Blueprint, identifiers: bool = False) -> None:
        self.blueprint = blueprint
        self._identifiers = identifiers
        names = (one.name for branch in blueprint for one in branch.notes.facts.values())
        self._facts = Counter(name for name in names if name)
        self._several = len(blueprint) > 1

    def operation(self, edge: Address) -> str:
        """Return the title of an operation."""
        title = self.blueprint[edge.branch].operation_note(edge.state, edge.operation).title
        shown = title or UNTITLED
        return f"{shown} [{edge.operation}]" if self._identifiers else shown

    def quoted(self, edge: Address) -> str:
        """Return the title of an operation within a sentence."""
        title = self.blueprint[edge.branch].operation_note(edge.state, edge.operation).title
        if not title and not self._identifiers:
            return "a step without a title"
        return f"“{self.operation(edge)}”"

    def state(self, branch: StateBranch, state: str) -> str:
        """Return the title of a state within a sentence, or else its facts in words."""
        note = branch.state_note(state)
        if note is not None and note.title:
            shown = f"“{note.title}”"
        else:
            shown = self.facts(branch, enumerate(branch.facts(state))) or "a state without facts"
        return f"{shown} [{state}]" if self._identifiers else shown

    def fact(self, branch: StateBranch, digit: int) -> str:
        """Return the name of a fact. If another fact has the same name, the SB stands with it."""
        name = branch.fact_name(digit)
        note = branch.fact_note(digit)
        named = note is not None and bool(note.name)
        if self._facts[name] == 1 if named else not self._several:
            return name
        return f"{name} of {branch.name}"

    def fact_is(self, branch: StateBranch, digit: int, value: str) -> str:
        """Return a fact with its value in words, such as ``Head: fixed in the clamp``."""
        return f"{self.fact(branch, digit)}: {self.value(branch, digit, value)}"

    def value(self, branch: StateBranch, digit: int, value: str) -> str:
        """Return what a value means. Of a named fact with the values 0 and 1 they are no and
        yes.
        """
        note = branch.fact_note(digit)
        meaning = note.values.get(value, "") if note is not None else ""
        if meaning:
            return meaning
        known = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
        if note is not None and note.name and {value, *known} <= BINARY:
            return "yes" if value == "1" else "no"
        return value

    def facts(self, branch: StateBranch, values: Iterable[tuple[int, str]]) -> str:
        """Return several facts of an SB with their values as one part of a sentence."""
        return listed([f"“{self.fact_is(branch, digit, value)}”" for digit, value in values])

    def required(self, requires: Mapping[str, str]) -> str:
        """Return what an operation requires, as one part of a sentence."""
        said = []
        for text, value in requires.items():
            fact = split_fact(text)
            branch = self.blueprint.branches.get(fact[0]) if fact else None
            if fact is None or branch is None or fact[1] >= branch.num_facts:
                said.append(f"“{text}: {value}”")
            else:
                said.append(f"“{self.fact_is(branch, fact[1], value)}”")
        return listed(said)

    def path(self, path: Sequence[Address]) -> str:
        """Return operations that follow each other, as one part of a sentence."""
        shown = [self.quoted(one) for one in path[:MOST_NAMED]]
        more = len(path) - len(shown)
        return ", then ".join(shown) + (f", and {more:,} more" if more else "")


def listed(words: Sequence[str]) -> str:
    """Return words as ``a, b and c``. Of very many the first are named and the others counted."""
    shown = list(words[:MOST_NAMED])
    if len(words) > MOST_NAMED:
        shown.append(f"{len(words) - MOST_NAMED:,} more")
    if len(shown) < 2:
        return "".join(shown)
    return f"{', '.join(shown[:-1])} and {shown[-1]}"


def counted(many: int, noun: str) -> str:
    """Return a number with its noun, such as ``3 steps``."""
    return f"{many:,} {noun}{'' if many == 1 else 's'}"


def duration(seconds: float) -> str:
    """Return a time in words: seconds, or minutes if there are two or more."""
    if seconds >= 120 and seconds % 60 == 0:
        return f"{seconds / 60:,.0f} minutes"
    return "1 second" if seconds == 1 else f"{seconds:,g} seconds"


def people(roles: Sequence[str]) -> str:
    """Return the persons that a task asks, within a sentence. An empty role is anybody."""
    count = Counter(role or "person" for role in roles or NOBODY)
    said = [
        ("a person" if role == "person" else f"the {role}")
        if many == 1
        else f"{many} different persons ({role})"
        for role, many in count.items()
    ]
    return listed(said)


def opened(sentence: str) -> str:
    """Return a sentence with a capital letter at its beginning."""
    return sentence[:1].upper() + sentence[1:]


def untitled(blueprint: Blueprint) -> Untitled:
    """Count what lacks a title or a name. Operations of one name count once in each SB."""
    operations = states = facts = 0
    for branch in blueprint:
        if not any(key in branch.fields for key in ("_facts", "_states", "_operations")):
            operations += len(branch.operation_names)
            states += len(branch.table)
            facts += branch.num_facts if branch.table else 0
            continue
        bare: dict[str, bool] = {}
        for edge in branch.edges():
            note = branch.operation_note(edge.source, edge.name)
            bare[edge.name] = bare.get(edge.name, True) and not note.title
        operations += sum(bare.values())
        notes = (branch.state_note(state) for state in branch.table)
        states += sum(note is None or not note.title for note in notes)
        named = {digit for digit, note in branch.notes.facts.items() if note.name}
        facts += len(set(range(branch.num_facts)) - named) if branch.table else 0
    return Untitled(operations, states, facts)
