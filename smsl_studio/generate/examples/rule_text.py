"""Learnt rules as the TOML text that ``generate rules`` reads."""

from __future__ import annotations

import json
from collections.abc import Iterable

from smsl_studio.generate.examples.cases import LearntCase, LearntRule
from smsl_studio.generate.examples.cover import formula_text
from smsl_studio.generate.examples.rule_search import LearntRules

MOST_LINES = 120
"""A text with more lines than this is written with all cases of a rule in one line."""


def rules_text(learnt: LearntRules) -> str:
    """Return the text of a file of rules."""
    for loose in (True, False):
        text = _text(learnt, loose)
        if text.count("\n") <= MOST_LINES:
            break
    return text


def _text(learnt: LearntRules, loose: bool) -> str:
    table = learnt.table
    lines = [f"sb = {_string(table.branch)}", "facts = ["]
    for name, values in zip(learnt.names, table.alphabets, strict=True):
        lines.append(f"    {{name = {_string(name)}, values = {_strings(values)}}},")
    lines += ["]", f"start = {_strings(table.start)}"]
    if table.goal is not None:
        lines.append(f"goal = {_strings(table.goal)}")
    if learnt.never:
        lines += ["never = [", *(f"    {_string(one)}," for one in learnt.never), "]"]
    for rule in learnt.rules:
        lines += [""] * loose
        lines += _rule_lines(rule, loose)
    return "\n".join(lines) + "\n"


def _rule_lines(rule: LearntRule, loose: bool) -> list[str]:
    lines = ["[[rule]]", f"operation = {_string(rule.family.pattern)}"]
    if rule.family.choices:
        choices = ", ".join(
            f"{name} = {_strings(values)}" for name, values in rule.family.choices.items()
        )
        lines.append(f"for = {{{choices}}}")
    cases = [_case_text(case, rule) for case in rule.cases]
    if len(cases) == 1 or not loose:
        return [*lines, f"cases = [{', '.join(cases)}]"]
    return [*lines, "cases = [", *(f"    {case}," for case in cases), "]"]


def _case_text(case: LearntCase, rule: LearntRule) -> str:
    when = formula_text(case.when, rule.atoms)
    sets = ", ".join(f"{_string(fact)} = {_string(value)}" for fact, value in case.change)
    change = f"set = {{{sets}}}"
    return f"{{when = {_string(when)}, {change}}}" if when else f"{{{change}}}"


def _strings(texts: Iterable[str]) -> str:
    return f"[{', '.join(_string(one) for one in texts)}]"


def _string(text: str) -> str:
    """Return a TOML string. A text with double quotes stands in single ones if it can."""
    if '"' in text and "'" not in text and text.isprintable():
        return f"'{text}'"
    return json.dumps(text).replace("\x7f", "\\u007f")
