"""Rules of a procedure in a TOML file: facts with their values, a start, a goal, and what each
operation changes when.

The file may come from anywhere. Every fault is one ReadError with its line.
"""

from __future__ import annotations

import itertools
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.errors import FormulaError, Place, ReadError, did_you_mean, instead_of
from smsl_studio.generate.rule_conditions import Alphabets, Condition, Values, condition
from smsl_studio.generate.rule_fixes import word_fix
from smsl_studio.stop import heed

Json = Any
LARGEST = 1 << 20
"""The largest size of a file of rules (bytes)."""
MOST_OPERATIONS = 100_000
"""The largest number of operations that rules may name."""
_TOP = {"sb", "facts", "start", "goal", "never", "rule"}
_RULE = {"operation", "for", "cases"}
_ERROR = re.compile(r"\(at line (\d+), column (\d+)\)")
_END = "(at end of document)"
_LONG_NUMBER = re.compile(r"[0-9][0-9_]{4000}")
_BRACES = re.compile(r"[{}]")
_LONGEST = 10_000
"""The most letters of a text, also after values of ``for`` stand in it."""
_LARGE = 10**18
"""A whole number must be smaller than this to stand for a name or a value. Python refuses to write
very long numbers."""
_SHOWN = 200


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
    of each condition."""

    branch: str
    facts: Alphabets
    start: Values
    goal: Values | None
    never: tuple[tuple[str, Condition], ...]
    operations: tuple[RuleOperation, ...]


def read_rules(raw: bytes, file: str, faults: list[ReadError] | None = None) -> RuleSet:
    """Return the rules in a file. ReadError with the line of the first fault.

    With a list of ``faults`` a rule or a condition of ``never`` that cannot be read is left out,
    and its error is added to the list.
    """
    return _RuleFile(raw, file, faults).rules()


class _RuleFile:
    def __init__(self, raw: bytes, file: str, faults: list[ReadError] | None) -> None:
        self._file, self._faults = file, faults
        if len(raw) > LARGEST:
            raise self._fault("the rules are longer than 1 MB", "", "Rules are short: use 'for'.")
        try:
            self._text = raw.decode("utf-8")
            self._values: dict[str, Json] = tomllib.loads(self._text)
        except (ValueError, RecursionError) as error:
            raise _no_toml(error, getattr(self, "_text", ""), file) from None

    def rules(self) -> RuleSet:
        self._members(self._values, _TOP, "the file", "")
        branch = self._text_of(self._values.get("sb", "SB1"), "sb")
        self._check_name(branch, "sb")
        facts = self._facts()
        start = self._state(self._values.get("start"), facts, "start")
        goal = self._values.get("goal")
        never = self._values.get("never", [])
        if not isinstance(never, list):
            raise self._fault("'never' is no list of conditions", "never")
        return RuleSet(
            branch,
            facts,
            start,
            None if goal is None else self._state(goal, facts, "goal"),
            tuple(found for text in never for found in self._never(text, facts)),
            tuple(self._operations(facts)),
        )

    def _facts(self) -> dict[str, tuple[str, ...]]:
        told = self._values.get("facts")
        if not isinstance(told, list) or not told:
            raise self._fault("'facts' is no list of facts", "facts", _FACTS)
        facts: dict[str, tuple[str, ...]] = {}
        for one in told:
            if not isinstance(one, dict):
                raise self._fault("a fact is no table", "facts", _FACTS)
            self._members(one, {"name", "values"}, "a fact", "facts")
            name = self._text_of(one.get("name"), "name")
            if name.isdecimal():
                near = f'name = "{name}"'
                raise self._fault(
                    f"a fact cannot have the name {_short(name)}",
                    near if near in self._text else "facts",
                    "A whole number is the digit of a fact. Use letters in its name.",
                )
            values = one.get("values")
            if not isinstance(values, list) or not values:
                raise self._fault(f"the fact {name} has no list of values", name, _FACTS)
            texts = tuple(self._text_of(value, "values") for value in values)
            if name in facts or len(set(texts)) < len(texts):
                raise self._fault(f"the fact {name}, or one of its values, stands twice", name)
            facts[name] = texts
        every = [value for values in facts.values() for value in values]
        other = next((value for value in every if len(value) != len(every[0])), None)
        if other is not None:
            raise self._fault(
                "all values must have the same number of characters: "
                f"{_short(every[0])} and {_short(other)} have not", "values",
                "The name of a state is made of them. Take short ones, such as 0, 1 and B.",
            )  # fmt: skip
        return facts

    def _state(self, told: Json, facts: Alphabets, what: str) -> Values:
        if not isinstance(told, list) or len(told) != len(facts):
            raise self._fault(
                f"{what!r} is no list of {len(facts)} values", what, "Write one value a fact."
            )
        values = tuple(self._text_of(value, what) for value in told)
        for (name, known), value in zip(facts.items(), values, strict=True):
            if value not in known:
                raise self._fault(
                    f"the fact {name} has no value {value!r}", what, f"It has {', '.join(known)}.",
                    instead_of(value, known),
                )  # fmt: skip
        return values

    def _operations(self, facts: Alphabets) -> Iterator[RuleOperation]:
        rules = self._values.get("rule", [])
        if not isinstance(rules, list) or not rules:
            self._leave_out(
                self._fault("there is no [[rule]]", "", "Write one for each kind of operation.")
            )
            return
        names: set[str] = set()
        for rule in rules:
            try:
                made = self._rule(rule, facts, names)
            except ReadError as error:
                self._leave_out(error)
            else:
                names.update(made)
                yield from made.values()

    def _rule(
        self, rule: Json, facts: Alphabets, names: Collection[str]
    ) -> dict[str, RuleOperation]:
        """Return the operations of one rule by name. ``names`` are those of the rules before."""
        if not isinstance(rule, dict):
            raise self._fault("a rule is no table", "rule")
        pattern = self._text_of(rule.get("operation"), "operation")
        self._members(rule, _RULE, f"the rule {pattern}", pattern)
        cases = rule.get("cases")
        if not isinstance(cases, list) or not cases:
            raise self._fault(f"the rule {pattern} has no list of cases", pattern, _CASES)
        found: dict[str, RuleOperation] = {}
        for given in self._choices(rule.get("for", {}), pattern):
            heed()
            name = self._filled(pattern, given, pattern)
            self._check_name(name, pattern)
            if name in names or name in found:
                raise self._fault(f"the operation {name} is made twice", pattern)
            if len(names) + len(found) == MOST_OPERATIONS:
                raise self._fault(
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
        """Add the fault of a part to the list. Without a list it is that of the file."""
        if self._faults is None:
            raise error
        self._faults.append(error)

    def _choices(self, told: Json, pattern: str) -> Iterator[Mapping[str, str]]:
        if not isinstance(told, dict):
            raise self._fault(f"'for' of the rule {pattern} is no table", pattern, _FOR)
        lists: list[list[str]] = []
        for name, values in told.items():
            if not isinstance(values, list) or not values:
                raise self._fault(f"{name} of the rule {pattern} has no values", pattern, _FOR)
            texts = [self._text_of(value, name) for value in values]
            if any(_BRACES.search(text) for text in (name, *texts)):
                raise self._fault(f"'for' of the rule {pattern} contains braces", pattern, _FOR)
            lists.append(texts)
        for chosen in itertools.product(*lists):
            yield dict(zip(told, chosen, strict=True))

    def _case(
        self, case: Json, given: Mapping[str, str], facts: Alphabets, pattern: str
    ) -> RuleCase:
        if not isinstance(case, dict) or not isinstance(case.get("set"), dict):
            raise self._fault(f"a case of the rule {pattern} has no 'set'", pattern, _CASES)
        self._members(case, {"when", "set"}, f"a case of the rule {pattern}", pattern)
        when = case.get("when")
        holds = None if when is None else self._condition(when, facts, given, pattern)
        names = list(facts)
        change: dict[int, str] = {}
        for key, value in case["set"].items():
            place = self._key_place(key)
            name = self._filled(key, given, place)
            text = self._filled(self._text_of(value, key, place), given, place)
            if name not in facts:
                near = did_you_mean(name, names) or f"There are {', '.join(names)}."
                raise self._fault(
                    f"there is no fact {name!r} to set", place, near, instead_of(name, names)
                )
            if text not in facts[name]:
                known = f"It has {', '.join(facts[name])}."
                raise self._fault(
                    f"the fact {name} has no value {text!r}", place, known,
                    instead_of(text, facts[name]),
                )  # fmt: skip
            digit = names.index(name)
            if digit in change:
                raise self._fault(f"a case of the rule {pattern} sets {name} twice", place)
            change[digit] = text
        return RuleCase(holds, tuple(change.items()))

    def _condition(
        self, text: Json, facts: Alphabets, given: Mapping[str, str], near: str
    ) -> Condition:
        written = self._text_of(text, "a condition", near)
        near = written if written in self._text else near
        try:
            return condition(self._replaced(written, given, near), facts)
        except FormulaError as error:
            advice = _advice_of_braces(error, given) or error.advice
            raise self._fault(
                f"the condition {_short(written)}: {error.sentence}", near, advice,
                error.instead, 0 if "{" in written else error.at,
            ) from None  # fmt: skip

    def _filled(self, text: str, given: Mapping[str, str], near: str) -> str:
        """Return a name with each ``{x}`` replaced. ReadError if a brace is left."""
        filled = self._replaced(text, given, near)
        if _BRACES.search(filled):
            raise self._fault(f"no value is given for the braces in {_short(text)}", near, _FOR)
        return filled

    def _replaced(self, text: str, given: Mapping[str, str], near: str) -> str:
        """Return a text with each ``{x}`` replaced. No value has braces."""
        for name, value in given.items():
            text = text.replace(f"{{{name}}}", value)
            if len(text) > _LONGEST:
                raise self._fault(f"a text with values of 'for' is longer than {_LONGEST:,}", near)
        return text

    def _key_place(self, key: str) -> str:
        """Return a text that stands where a key is set, if there is one, and else the key."""
        spellings = (f'"{key}" =', f"{key} =")
        return next((one for one in spellings if one in self._text), key)

    def _check_name(self, name: str, near: str) -> None:
        if name.startswith("_"):
            raise self._fault(
                f"a name cannot begin with _: {_short(name)}", near, "_ begins an annotation."
            )

    def _text_of(self, value: Json, what: str, near: str = "") -> str:
        if isinstance(value, int) and not isinstance(value, bool) and abs(value) < _LARGE:
            return str(value)
        if not isinstance(value, str) or not value or len(value) > _LONGEST:
            raise self._fault(f"{what} is missing, empty or no text", near or what)
        return value

    def _members(self, values: Mapping[str, Json], known: set[str], what: str, near: str) -> None:
        for name in values:
            if name not in known:
                advice = (
                    did_you_mean(name, sorted(known)) or f"There is {', '.join(sorted(known))}."
                )
                raise self._fault(
                    f"{what} has an unknown key {name!r}", name or near, advice,
                    instead_of(name, sorted(known)),
                )  # fmt: skip

    def _fault(
        self,
        sentence: str,
        near: str,
        advice: str = "",
        instead: tuple[str, str] = ("", ""),
        after: int = 0,
    ) -> ReadError:
        """Return an error at the line of the first place that has a text. ``instead`` is a wrong
        word, which stands there ``after`` some characters, and the right one."""
        text: str = getattr(self, "_text", "")
        at = max(0, text.find(near))
        line = text.count("\n", 0, at) + 1
        fix = word_fix(text, at + after, *instead)
        return ReadError(sentence, Place(self._file, line, 1), advice, fix=fix)


_FACTS = 'Write facts = [{name = "disk 1", values = ["a", "b"]}].'
_CASES = 'Write cases = [{when = "a = 0", set = {a = "1"}}].'
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


def _short(text: str) -> str:
    """Return a text as a message shows it."""
    return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}...")


def _no_toml(error: Exception, text: str, file: str) -> ReadError:
    """Return the error for bytes that are no TOML, with the line that Python names.

    It names none for a number that is too long, and no number for the end of the text.
    """
    told = str(error)
    line, column = 1, 1
    if found := _ERROR.search(told):
        line, column = int(found[1]), int(found[2])
    elif _END in told:
        line = max(1, len(text.splitlines()))
    elif long := _LONG_NUMBER.search(text):
        line = text.count("\n", 0, long.start()) + 1
    words = _ERROR.sub("", told).strip()
    return ReadError(f"this is no TOML: {words}", Place(file, line, column), "See docs/rules.md.")
