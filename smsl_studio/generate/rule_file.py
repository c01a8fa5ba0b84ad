"""Rules of a procedure in a TOML file: facts with their values, a start, a goal, and what each
operation changes when.

The file may come from anywhere. Every fault is one ReadError with its line.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from math import prod
from typing import Any

from smsl_studio.blueprint.properties.formula_text import FORM
from smsl_studio.errors import FormulaError, Place, ReadError, did_you_mean, instead_of
from smsl_studio.generate.rule_conditions import Alphabets, Condition, Values, condition
from smsl_studio.generate.rule_source import LONGEST, RuleSource, short
from smsl_studio.stop import heed

Json = Any
MOST_OPERATIONS = 100_000
"""The largest number of operations that rules may name."""
_MOST_FAULTS = 20
"""So many faults of a file are told at once."""
_TOP = {"sb", "facts", "start", "goal", "never", "rule"}
_RULE = {"operation", "for", "cases"}
_BRACES = re.compile(r"[{}]")


@dataclass(frozen=True, slots=True)
class RuleCase:
    """What an operation changes where a condition holds: digits with their new values. Without a
    condition it always does."""

    when: Condition | None
    change: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True)
class RuleOperation:
    """An operation with its cases. The first case that holds wins."""

    name: str
    cases: tuple[RuleCase, ...]


@dataclass(frozen=True, slots=True)
class RuleSet:
    """The rules of one State Branch. ``goal`` is None if the file has none. ``never`` has the text
    of each condition. ``start_at`` is the line of the start."""

    branch: str
    facts: Alphabets
    start: Values
    goal: Values | None
    never: tuple[tuple[str, Condition], ...]
    operations: tuple[RuleOperation, ...]
    start_at: Place


def read_rules(raw: bytes, file: str, faults: list[ReadError] | None = None) -> RuleSet:
    """Return the rules in a file. ReadError with the line of each fault, at most twenty.

    With a list of ``faults`` a rule or a condition of ``never`` that cannot be read is left out,
    and its error is added to the list.
    """
    found: list[ReadError] = []
    rules = _RuleFile(RuleSource(raw, file), found if faults is None else faults).rules()
    if found:
        raise ReadError.of(found[:_MOST_FAULTS])
    return rules


class _RuleFile:
    def __init__(self, source: RuleSource, faults: list[ReadError]) -> None:
        self._source, self._faults = source, faults

    def rules(self) -> RuleSet:
        self._source.members(self._source.values, _TOP, "the file", "")
        branch = self._source.text_of(self._source.values.get("sb", "SB1"), "sb")
        self._check_name(branch, "sb")
        facts = self._facts()
        start = self._state(self._source.values.get("start"), facts, "start")
        goal = self._source.values.get("goal")
        never = self._source.values.get("never", [])
        if not isinstance(never, list):
            raise self._source.fault("'never' is no list of conditions", "never")
        return RuleSet(
            branch,
            facts,
            start,
            None if goal is None else self._state(goal, facts, "goal"),
            tuple(found for text in never for found in self._never(text, facts)),
            tuple(self._operations(facts)),
            self._source.place("start ="),
        )

    def _facts(self) -> dict[str, tuple[str, ...]]:
        told = self._source.values.get("facts")
        if not isinstance(told, list) or not told:
            raise self._source.fault("'facts' is no list of facts", "facts", _FACTS)
        facts: dict[str, tuple[str, ...]] = {}
        for one in told:
            if not isinstance(one, dict):
                raise self._source.fault("a fact is no table", "facts", _FACTS)
            self._source.members(one, {"name", "values"}, "a fact", "facts")
            name = self._source.text_of(one.get("name"), "name")
            if name.isdecimal():
                near = f'name = "{name}"'
                raise self._source.fault(
                    f"a fact cannot have the name {short(name)}",
                    near if near in self._source.text else "facts",
                    "A whole number is the digit of a fact. Use letters in its name.",
                )
            values = one.get("values")
            if not isinstance(values, list) or not values:
                raise self._source.fault(f"the fact {name} has no list of values", name, _FACTS)
            texts = tuple(self._source.text_of(value, "values") for value in values)
            if name in facts or len(set(texts)) < len(texts):
                raise self._source.fault(
                    f"the fact {name}, or one of its values, stands twice", name
                )
            facts[name] = texts
        every = [value for values in facts.values() for value in values]
        other = next((value for value in every if len(value) != len(every[0])), None)
        if other is not None:
            raise self._source.fault(
                "all values must have the same number of characters: "
                f"{short(every[0])} and {short(other)} have not", "values",
                "The name of a state is made of them. Take short ones, such as 0, 1 and B.",
            )  # fmt: skip
        return facts

    def _state(self, told: Json, facts: Alphabets, what: str) -> Values:
        if not isinstance(told, list) or len(told) != len(facts):
            raise self._source.fault(
                f"{what!r} is no list of {len(facts)} values", what, "Write one value a fact."
            )
        values = tuple(self._source.text_of(value, what) for value in told)
        for (name, known), value in zip(facts.items(), values, strict=True):
            if value not in known:
                raise self._source.fault(
                    f"the fact {name} has no value {value!r}", what, f"It has {', '.join(known)}.",
                    instead_of(value, known),
                )  # fmt: skip
        return values

    def _operations(self, facts: Alphabets) -> Iterator[RuleOperation]:
        rules = self._source.values.get("rule", [])
        if not isinstance(rules, list) or not rules:
            self._leave_out(
                self._source.fault(
                    "there is no [[rule]]", "", "Write one for each kind of operation."
                )
            )
            return
        names: set[str] = set()
        for number, rule in enumerate(rules):
            self._source.enter(number, len(rules))
            try:
                made = self._rule(rule, facts, names)
            except ReadError as error:
                self._leave_out(error)
            else:
                names.update(made)
                yield from made.values()
        self._source.leave()

    def _rule(
        self, rule: Json, facts: Alphabets, names: Collection[str]
    ) -> dict[str, RuleOperation]:
        """Return the operations of one rule by name. ``names`` are those of the rules before."""
        if not isinstance(rule, dict):
            raise self._source.fault("a rule is no table", "rule")
        pattern = self._source.text_of(rule.get("operation"), "operation")
        self._source.members(rule, _RULE, f"the rule {pattern}", pattern)
        cases = rule.get("cases")
        if not isinstance(cases, list) or not cases:
            raise self._source.fault(f"the rule {pattern} has no list of cases", pattern, _CASES)
        found: dict[str, RuleOperation] = {}
        for given in self._choices(rule.get("for", {}), pattern):
            heed()
            name = self._filled(pattern, given, pattern)
            self._check_name(name, pattern)
            if name in names or name in found:
                raise self._source.fault(f"the operation {name} is made twice", pattern)
            if len(names) + len(found) == MOST_OPERATIONS:
                raise self._source.fault(
                    f"the rules name more than {MOST_OPERATIONS:,} operations", pattern
                )
            made = tuple(self._case(case, given, facts, pattern) for case in cases)
            found[name] = RuleOperation(name, made)
        return found

    def _never(self, text: Json, facts: Alphabets) -> Iterator[tuple[str, Condition]]:
        try:
            yield text, self._condition(text, facts, {}, "never")
        except ReadError as error:
            self._leave_out(error)

    def _leave_out(self, error: ReadError) -> None:
        """Leave out a part that cannot be read, and note its fault."""
        self._faults.append(error)

    def _choices(self, told: Json, pattern: str) -> Iterator[Mapping[str, str]]:
        if not isinstance(told, dict):
            raise self._source.fault(f"'for' of the rule {pattern} is no table", pattern, _FOR)
        lists: list[list[str]] = []
        for name, values in told.items():
            if not isinstance(values, list) or not values:
                raise self._source.fault(
                    f"{name} of the rule {pattern} has no values", pattern, _FOR
                )
            texts = [self._source.text_of(value, name) for value in values]
            if any(_BRACES.search(text) for text in (name, *texts)):
                raise self._source.fault(
                    f"'for' of the rule {pattern} contains braces", pattern, _FOR
                )
            lists.append(texts)
        if prod(map(len, lists)) > MOST_OPERATIONS:
            raise self._source.fault(
                f"the rule {pattern} names more than {MOST_OPERATIONS:,} operations", pattern
            )
        for chosen in itertools.product(*lists):
            yield dict(zip(told, chosen, strict=True))

    def _case(
        self, case: Json, given: Mapping[str, str], facts: Alphabets, pattern: str
    ) -> RuleCase:
        if not isinstance(case, dict) or not isinstance(case.get("set"), dict):
            raise self._source.fault(f"a case of the rule {pattern} has no 'set'", pattern, _CASES)
        self._source.members(case, {"when", "set"}, f"a case of the rule {pattern}", pattern)
        when = case.get("when")
        holds = None if when is None else self._condition(when, facts, given, pattern)
        names = list(facts)
        change: dict[int, str] = {}
        for key, value in case["set"].items():
            place = self._source.set_place(key, value)
            name = self._filled(key, given, place)
            text = self._filled(self._source.text_of(value, key, place), given, place)
            if name not in facts:
                near = did_you_mean(name, names) or f"There are {', '.join(names)}."
                raise self._source.fault(
                    f"there is no fact {name!r} to set", place, near, instead_of(name, names)
                )
            if text not in facts[name]:
                known = f"It has {', '.join(facts[name])}."
                raise self._source.fault(
                    f"the fact {name} has no value {text!r}", place, known,
                    instead_of(text, facts[name]),
                )  # fmt: skip
            digit = names.index(name)
            if digit in change:
                raise self._source.fault(f"a case of the rule {pattern} sets {name} twice", place)
            change[digit] = text
        return RuleCase(holds, tuple(change.items()))

    def _condition(
        self, text: Json, facts: Alphabets, given: Mapping[str, str], near: str
    ) -> Condition:
        written = self._source.text_of(text, "a condition", near)
        near = written if written in self._source.text else near
        where = "".join(
            f", where {{{name}}} is {short(value)}"
            for name, value in given.items()
            if f"{{{name}}}" in written
        )
        try:
            return condition(self._replaced(written, given, near), facts)
        except FormulaError as error:
            advice = _advice_of_braces(error, given) or error.advice
            if advice == FORM:
                advice = _CONDITION
            raise self._source.fault(
                f"the condition {short(written)}{where}: {error.sentence}", near, advice,
                error.instead, 0 if "{" in written else error.at,
            ) from None  # fmt: skip

    def _filled(self, text: str, given: Mapping[str, str], near: str) -> str:
        """Return a name with each ``{x}`` replaced. ReadError if a brace is left."""
        filled = self._replaced(text, given, near)
        if _BRACES.search(filled):
            raise self._source.fault(
                f"no value is given for the braces in {short(text)}", near, _FOR
            )
        return filled

    def _replaced(self, text: str, given: Mapping[str, str], near: str) -> str:
        """Return a text with each ``{x}`` replaced. No value has braces."""
        for name, value in given.items():
            text = text.replace(f"{{{name}}}", value)
            if len(text) > LONGEST:
                raise self._source.fault(
                    f"a text with values of 'for' is longer than {LONGEST:,}", near
                )
        return text

    def _check_name(self, name: str, near: str) -> None:
        if name.startswith("_"):
            raise self._source.fault(
                f"a name cannot begin with _: {short(name)}", near, "_ begins an annotation."
            )


_FACTS = 'Write facts = [{name = "disk 1", values = ["a", "b"]}].'
_CASES = 'Write cases = [{when = "a = 0", set = {a = "1"}}].'
_CONDITION = (
    'A condition is such as: disk1 = a and not ("disk 2" != b or count(disk1, disk3 = c) > 1). '
    "A name with spaces stands in double quotes, also where {x} stands for it."
)
_FOR = 'Write for = {x = ["a", "b"]}.'


def _advice_of_braces(error: FormulaError, given: Mapping[str, str]) -> str:
    """Return what to do where a value of ``for`` stands in the place of a fact and is none."""
    name = next((name for name, value in given.items() if f"fact {value!r}" in error.sentence), "")
    if not name:
        return ""
    return (
        f"Here {{{name}}} stands for {given[name]}, and that is no fact. Where operations differ, "
        "write a rule for each."
    )
