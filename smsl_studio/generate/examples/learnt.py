"""What was learnt from examples: the text of the rules, and the examples that do not fit."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import PlanningError
from smsl_studio.generate.examples.mistakes import repaired
from smsl_studio.generate.examples.rule_search import learnt_rules
from smsl_studio.generate.examples.rule_text import rules_text
from smsl_studio.generate.examples.table import ExampleTable, Values
from smsl_studio.generate.rule_file import read_rules
from smsl_studio.generate.rule_states import ruled_branch


@dataclass(frozen=True)
class RuleException:
    """An edge that does not fit the rules. ``kind`` is ``missing`` (the rules have it) or ``odd``.

    ``found`` is the state to which it leads, ``expected`` the one to which the rules lead. None if
    there is no such edge.
    """

    address: str
    kind: str
    found: str | None
    expected: str | None


@dataclass(frozen=True)
class Learnt:
    """Rules as the text of a TOML file, their number of cases, and what does not fit them."""

    text: str
    cases: int
    exceptions: tuple[RuleException, ...]


def learnt_from(table: ExampleTable) -> Learnt:
    """Return the rules of some examples.

    PlanningError if they have no fewer cases than there are examples, or if none are found.
    """
    regular = repaired(table)
    rules = learnt_rules(regular)
    if rules.cases >= table.count:
        raise PlanningError(
            f"the rules would have {rules.cases:,} cases for {table.count:,} operations: they are "
            "no shorter than the blueprint",
            advice="Rules are for procedures in which an operation does the same in many states.",
        )
    text = rules_text(rules)
    _must_regenerate(text, regular)
    return Learnt(text, rules.cases, _exceptions(table, regular))


def _exceptions(table: ExampleTable, regular: ExampleTable) -> tuple[RuleException, ...]:
    found: list[RuleException] = []
    for values, state in table.names.items():
        for operation in dict.fromkeys((*table.edges, *regular.edges)):
            target = table.edges.get(operation, {}).get(values)
            expected = regular.edges.get(operation, {}).get(values)
            if target != expected:
                found.append(
                    RuleException(
                        str(Address(table.branch, state, operation)),
                        "missing" if target is None else "odd",
                        _name(table, target),
                        _name(table, expected),
                    )
                )
    return tuple(found)


def _name(table: ExampleTable, values: Values | None) -> str | None:
    return None if values is None else table.names[values]


def _must_regenerate(text: str, table: ExampleTable) -> None:
    """Read the rules again and follow them. They must give the edges of the table."""
    made = ruled_branch(read_rules(text.encode(), "rules"), limit=len(table.names))
    if not made.whole:
        raise PlanningError("the rules that were found lead to further states")
    rows = made.values[table.branch]
    names = {"State_" + "".join(values): values for values in table.names}
    for state, row in rows.items():
        if state != "HEADER":
            values = names[state]
            own = {o: "State_" + "".join(e[values]) for o, e in table.edges.items() if values in e}
            if row != own:
                raise PlanningError(f"the rules that were found do not give {state} again")
