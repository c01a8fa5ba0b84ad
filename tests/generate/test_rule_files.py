"""Blueprints from files of rules: the families of the paper's authors, and files that are wrong."""

from __future__ import annotations

import itertools
import json
import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest

import smsl_studio as smsl
from benches.layouts.procedures import chess, river
from smsl_studio.errors import ReadError
from smsl_studio.generate import rule_states
from smsl_studio.generate.rule_circuit import RuleCircuit, bits, every_state
from smsl_studio.generate.rule_conditions import Alphabets, condition
from smsl_studio.generate.rule_file import read_rules
from smsl_studio.generate.rule_states import ruled_branch
from smsl_studio.shipped import samples_dir
from tests.generate import brute_force, plain_procedures
from tests.generate.plain_procedures import Steps

RULES = samples_dir() / "rules"
FOREIGN = Path(__file__).parent / "foreign_rules"
"""Rules that somebody wrote who knew the documentation alone."""


def table_of(name: str) -> dict[str, dict[str, str]]:
    """The states and operations that the rules of a sample give."""
    branch = smsl.generate_rules(RULES / f"{name}.toml").blueprint
    (only,) = branch
    return {state: dict(operations) for state, operations in only.table.items()}


@pytest.mark.parametrize(
    ("name", "table"),
    [
        ("hanoi-3", brute_force.hanoi(3)),
        ("hanoi-4", brute_force.hanoi(4)),
        ("river", river()),
        ("chess", chess()),
        ("registration", brute_force.registration()),
    ],
)
def test_the_families_are_those_of_an_independent_search(
    name: str, table: dict[str, dict[str, str]]
) -> None:
    assert table_of(name) == table


@pytest.mark.parametrize(
    ("name", "start", "steps"),
    [
        ("sluice", ("shut", "shut", "down"), plain_procedures.sluice),
        ("syringes", ("E", "E", "E"), plain_procedures.syringes),
        ("robots", ("A", "C"), plain_procedures.robots),
        ("jugs", ("0", "0"), plain_procedures.jugs),
        ("theatre", ("s", "s", "w", "c", "o"), plain_procedures.theatre),
    ],
)
def test_rules_written_from_the_documentation_alone_say_what_was_meant(
    name: str, start: plain_procedures.State, steps: Callable[[plain_procedures.State], Steps]
) -> None:
    made = smsl.generate_rules(FOREIGN / f"{name}.toml")
    (only,) = made.blueprint
    found = {state: dict(operations) for state, operations in only.table.items()}
    assert found == plain_procedures.searched(start, steps)
    assert made.goal_reached


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('large = "0"}}', 'large = "9"}}', "the fact large has no value '9'"),
        ("small = 3 and large = 4", "small = 3 and lager = 4", "there is no fact 'lager'"),
        ('{"{jug}" = "0"}', '{"{jug}" = "00"}', "the fact small has no value '00'"),
        ("{jug} != 0", "{jug} 0", "where {jug} is 'small'"),
    ],
)
def test_a_fault_is_told_in_the_line_of_its_rule(old: str, new: str, words: str) -> None:
    text = (FOREIGN / "jugs.toml").read_text()
    with pytest.raises(ReadError, match=re.escape(words)) as told:
        read_rules(text.replace(old, new, 1).encode(), "jugs.toml")
    assert told.value.place is not None
    assert told.value.place.line == text[: text.index(old)].count("\n") + 1


def test_all_faults_of_a_file_are_told_at_once() -> None:
    text = (FOREIGN / "jugs.toml").read_text()
    wrong = text.replace("small != 3", "smal != 3").replace("small = 3 and large = 4", "large")
    with pytest.raises(ReadError) as told:
        read_rules(wrong.encode(), "jugs.toml")
    first, second = told.value.faults
    assert "there is no fact 'smal'" in first.sentence
    assert "Did you mean small?" in first.advice
    assert "disk1 = a" in second.advice, "the example is one of rules, which know no states"
    assert first.place is not None
    assert second.place is not None
    assert first.place.line < second.place.line


def test_registration_is_the_papers() -> None:
    made = smsl.generate_rules(RULES / "registration.toml").blueprint
    paper = smsl.read(samples_dir() / "registration.json")
    assert smsl.diff_behaviour(made, paper).equal


def hanoi_rules(disks: int) -> str:
    """The rules of the sample for another number of disks."""
    pegs = "values = ['a', 'b', 'c']"
    facts = ", ".join(f"{{name = 'disk {n}', {pegs}}}" for n in range(1, disks + 1))
    text = f"facts = [{facts}]\nstart = {['a'] * disks}\ngoal = {['c'] * disks}\n"
    for n in range(1, disks + 1):
        cases = []
        for peg in "abc":
            parts = [f"'disk {n}' = {peg}", f"'disk {n}' != {{to}}"]
            parts += [f"'disk {m}' != {w}" for m in range(1, n) for w in (peg, "{to}")]
            cases.append(f"{{when = \"{' and '.join(parts)}\", set = {{'disk {n}' = '{{to}}'}}}}")
        text += f"[[rule]]\noperation = 'Op_{n}{{to}}'\nfor = {{to = ['a', 'b', 'c']}}\n"
        text += f"cases = [{', '.join(cases)}]\n"
    return text


@pytest.mark.parametrize("disks", range(1, 9))
def test_hanoi_with_any_number_of_disks_is_that_of_brute_force(disks: int) -> None:
    made = ruled_branch(read_rules(hanoi_rules(disks).encode(), "hanoi.toml"))
    table = {name: row for name, row in made.values["SB1"].items() if name != "HEADER"}
    assert table == brute_force.hanoi(disks)
    assert (made.states, made.operations) == (3**disks, 3 * (3**disks - 1))
    assert made.goal_reached


def test_every_sample_reaches_its_goal_and_says_where_it_comes_from() -> None:
    for file in sorted(RULES.glob("*.toml")):
        made = smsl.generate_rules(file)
        assert made.goal_reached
        assert made.states == sum(len(branch.table) for branch in made.blueprint)
        assert made.blueprint.fields["_origin"]["how"] == "rules"
        assert made.blueprint.fields["_origin"]["from"] == file.name


HEAD = """\
facts = [{name = "a", values = ["0", "1"]}, {name = "b c", values = ["0", "1"]}]
start = ["0", "0"]
"""
RULE = '[[rule]]\noperation = "flip"\ncases = [{when = "a = 0", set = {a = "1"}}]\n'


def rules(text: str) -> None:
    read_rules(text.encode(), "rules.toml")


def test_the_first_case_wins_and_a_goal_can_be_out_of_reach() -> None:
    text = f"""{HEAD}goal = ["1", "1"]
[[rule]]
operation = "go"
cases = [{{when = "a = 0", set = {{a = "1"}}}}, {{set = {{a = "0"}}}}]
"""
    made = ruled_branch(read_rules(text.encode(), "rules.toml"))
    assert made.values["SB1"]["State_00"] == {"go": "State_10"}
    assert made.values["SB1"]["State_10"] == {"go": "State_00"}
    assert (made.states, made.goal_reached) == (2, False)
    assert "ACTIVATING" not in made.values["SB1"]["HEADER"]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("facts = [", 1, "this is no TOML"),
        ("", 1, "'facts' is no list of facts"),
        (HEAD, 1, "there is no \\[\\[rule\\]\\]"),
        (HEAD + RULE + "more = 1\n", 6, "has an unknown key 'more'"),
        (HEAD.replace('["0", "0"]', '["0"]') + RULE, 2, "'start' is no list of 2 values"),
        (HEAD.replace('["0", "0"]', '["0", "2"]') + RULE, 2, "has no value '2'"),
        (HEAD + RULE.replace("a = 0", "a = 7"), 5, "the fact a has no value '7'"),
        (HEAD + RULE.replace("a = 0", "x = 0"), 5, "there is no fact 'x'"),
        (HEAD + RULE.replace("a = 0", "SB1 in State_0"), 5, "rules know facts and no states"),
        (HEAD + RULE.replace("a = 0", "a = "), 5, "a value is expected"),
        (HEAD + RULE.replace("a = 0", "count(a, z = 1) > 0"), 5, "there is no fact 'z'"),
        (HEAD + RULE.replace('set = {a = "1"}', 'set = {d = "1"}'), 5, "no fact 'd' to set"),
        (HEAD + RULE.replace('set = {a = "1"}', 'set = {a = "9"}'), 5, "has no value '9'"),
        (HEAD + RULE + RULE, 7, "the operation flip is made twice"),
        (HEAD.replace('"1"]}, {', '"11"]}, {') + RULE, 1, "the same number of characters"),
        (HEAD + RULE.replace("flip", "{x}").replace("cases", 'for = {x = ["go"]}\ncases')
         .replace("a = 0", "{x} = go"), 6, "there is no fact 'go'"),
        (HEAD + "[[rule]]\noperation = 'x'\ncases = 3\n", 4, "has no list of cases"),
        (HEAD + "[[rule]]\noperation = 'x'\nfor = 3\ncases = [{set = {}}]\n", 4, "is no table"),
        ("a = [" * 200, 1, "this is no TOML"),
        (HEAD + RULE.replace('"a = 0"', "\"'#count0' = 1\""), 5, "there is no fact '#count0'"),
        (HEAD + RULE.replace('"a = 0"', "\"'#countx' = 1\""), 5, "there is no fact '#countx'"),
        (HEAD + RULE.replace("a = 0", "'count' = 1 and count(a = 1) > 0"), 5, "no fact 'count'"),
        (HEAD + RULE.replace("a = 0", f"count({'9' * 5000} = 1) > 0"), 5, "a count cannot be read"),
        (HEAD + RULE.replace("a = 0", f"count({' ' * 3000}"), 5, "a count cannot be read"),
        (HEAD + RULE.replace("a = 0", "count(a = 1) > 1234567"), 5, "a count cannot be read"),
        (HEAD + RULE.replace("a = 0", "count(7 = 1) > 0"), 5, "there is no fact 7"),
        (HEAD.replace('["0", "0"]', f"[0x{'f' * 5000}, 0]") + RULE, 2, "start is missing"),
        (HEAD.replace('["0", "0"]', f"[{'9' * 5000}, 0]") + RULE, 2, "this is no TOML"),
        (HEAD + "facts = [", 3, "this is no TOML"),
        ('sb = "_SB"\n' + HEAD + RULE, 1, "a name cannot begin with _"),
        (HEAD + RULE.replace("flip", "_aa"), 4, "a name cannot begin with _"),
        (HEAD + RULE.replace("flip", "{x}").replace("cases", 'for = {x = ["_b"]}\ncases'), 4,
         "a name cannot begin with _"),
        (HEAD + RULE.replace("flip", "flip{x}"), 4, "no value is given for the braces in 'flip{x}"),
        (HEAD + RULE.replace("flip", "flip}"), 4, "no value is given for the braces in 'flip}"),
        (HEAD + RULE.replace("{a =", '{"{x}" ='), 5, "no value is given for the braces in '{x}'"),
        (HEAD + RULE.replace('a = "1"', 'a = "{x}"'), 5, "no value is given for the braces"),
        (HEAD + RULE.replace("cases", 'for = {x = ["{y}"]}\ncases'), 4, "contains braces"),
        (HEAD + RULE.replace("flip", "f{x}" * 50).replace("cases",
         f"for = {{x = ['{'a' * 900}']}}\ncases"), 4, "is longer than 10,000"),
        (HEAD + RULE.replace("flip", "f{x}").replace("{a =", '{a = "0", "{x}" =')
         .replace("cases", 'for = {x = ["a"]}\ncases'), 6, "sets a twice"),
        (HEAD.replace('"b c"', '"1"') + RULE, 1, "a fact cannot have the name '1'"),
    ],
)  # fmt: skip
def test_a_wrong_file_is_one_error_with_its_line(text: str, line: int, words: str) -> None:
    with pytest.raises(ReadError, match=words) as told:
        rules(text)
    assert told.value.place is not None
    assert told.value.place.line == line


def test_a_value_in_the_place_of_a_fact_is_told_by_its_braces() -> None:
    text = HEAD + RULE.replace("flip", "{x}").replace("cases", 'for = {x = ["go"]}\ncases')
    with pytest.raises(ReadError) as told:
        rules(text.replace("a = 0", "{x} = go"))
    assert told.value.advice.startswith("Here {x} stands for go, and that is no fact.")


def test_bytes_that_are_no_text_and_files_that_are_large_are_refused() -> None:
    for raw in (b"\xff\xfe", b"#" * ((1 << 20) + 1)):
        with pytest.raises(ReadError):
            read_rules(raw, "rules.toml")


def test_rules_without_an_end_are_bounded() -> None:
    facts = ", ".join(f'{{name = "f{n}", values = ["0", "1"]}}' for n in range(40))
    text = f"facts = [{facts}]\nstart = {['0'] * 40}\n"
    for n in range(40):
        text += f'[[rule]]\noperation = "o{n}"\ncases = [{{set = {{f{n} = "1"}}}}]\n'
    made = ruled_branch(read_rules(text.encode(), "rules.toml"), limit=5_000)
    assert (made.states, made.whole) == (5_000, False)
    rows = {name: row for name, row in made.values["SB1"].items() if name != "HEADER"}
    assert {target for row in rows.values() for target in row.values()} <= set(rows)
    assert made.operations == sum(map(len, rows.values()))
    assert made.operations > 5_000


def test_rules_that_name_very_much_are_refused_before_they_are_followed() -> None:
    letters = [f"v{number}" for number in range(300)]
    lists = "{" + ", ".join(f"{name} = {letters}" for name in "xyz") + "}"
    many = RULE.replace("flip", "flip{x}{y}{z}").replace("cases", f"for = {lists}\ncases")
    with pytest.raises(ReadError, match="names more than 100,000 operations"):
        rules(HEAD + many)
    with pytest.raises(ReadError, match="a key has more than 30 parts"):
        rules("a." * 30_000 + "a = 1\n")
    rules(HEAD + RULE + f"# {'a' * 100_000}\n")


@pytest.mark.parametrize(("limit", "most"), [("MAX_VALUES", 3_000), ("MAX_CHARACTERS", 200_000)])
def test_what_one_file_cannot_hold_is_left_out(
    limit: str, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rule_states, limit, most)
    made = ruled_branch(read_rules(hanoi_rules(8).encode(), "rules.toml"))
    text = json.dumps(made.values, indent=4)
    assert not made.whole
    assert len(text) < 200_000
    size = made.states + made.operations
    assert size < 3_000 if limit == "MAX_VALUES" else len(text) > 100_000
    assert size > 2_000


def test_a_start_that_is_left_out_is_refused() -> None:
    with pytest.raises(ReadError, match="the start is a state that 'never' leaves out") as told:
        ruled_branch(read_rules(f'{HEAD}never = ["a = 0"]\n{RULE}'.encode(), "rules.toml"))
    assert told.value.place is not None
    assert told.value.place.line == HEAD[: HEAD.index("start =")].count("\n") + 1


FACTS = {"a": ("0", "1", "2"), "b c": ("0", "1", "2"), "d": ("0", "1", "2")}


def holding(text: str, facts: Alphabets) -> list[bool]:
    """Whether a condition holds in each combination of values, the last fact changing first."""
    states = every_state(facts)
    circuit = RuleCircuit(facts, [condition(text, facts)])
    found = [bits(words, len(states) - at)[0] for at, words in circuit.holding(states)]
    return [truth for part in found for truth in part.tolist()]


def test_counts_are_taken_out_of_quotes_alone() -> None:
    facts = {"count(a = 1) > 0": ("0", "1"), "it's, (a)": ("0", "1"), "a": ("0", "1")}
    named = holding('"count(a = 1) > 0" = 1', facts)
    counted = holding("not count('it''s, (a)', \"it's, (a)\", 2 = '1') >= 2", facts)
    states = list(itertools.product("01", repeat=3))
    assert named == [values[0] == "1" for values in states]
    assert counted == [values[1] == "0" for values in states]


def some_condition(chance: random.Random, depth: int) -> tuple[str, str]:
    """A random condition about ``FACTS``, and the same in Python about values ``v``."""
    kind = chance.randrange(6 if depth else 3)
    if kind < 2:
        digit, value = chance.randrange(3), chance.choice("012")
        name = chance.choice([["a", '"b c"', "d"][digit], str(digit)])
        sign = chance.choice(["=", "!="])
        return f"{name} {sign} {value}", f"v[{digit}] {'==' if sign == '=' else sign} '{value}'"
    if kind == 2:
        value, number = chance.choice("012"), chance.randrange(5)
        sign = chance.choice(["=", "!=", "<", "<=", ">", ">="])
        python = "==" if sign == "=" else sign
        return (
            f"count(a, 'b c', d = {value}) {sign} {number}",
            f"v.count('{value}') {python} {number}",
        )
    one, other = some_condition(chance, depth - 1), some_condition(chance, depth - 1)
    if kind == 3:
        return f"not ({one[0]})", f"(not ({one[1]}))"
    word = "and" if kind == 4 else "or"
    return f"({one[0]}) {word} ({other[0]})", f"(({one[1]}) {word} ({other[1]}))"


def test_conditions_agree_with_python() -> None:
    """Random conditions against the same words in Python."""
    chance = random.Random(5)
    for _ in range(200):
        text, python = some_condition(chance, 3)
        states = itertools.product("012", repeat=3)
        assert holding(text, FACTS) == [eval(python, {"v": v}) for v in states], text


PlainCase = tuple[str, int, str]
"""A condition in Python, a digit, and its new value."""


def plainly_followed(
    start: tuple[str, ...], cases: list[list[PlainCase]], never: str
) -> dict[str, dict[str, str]]:
    """A plain search. Operation ``o3`` has the cases 3."""
    table: dict[str, dict[str, str]] = {}
    queue, known = [start], {start}
    for v in queue:
        own = table["State_" + "".join(v)] = {}
        for number, some in enumerate(cases):
            first = next((one for one in some if eval(one[0], {"v": v})), None)
            if first is None:
                continue
            _, digit, value = first
            after = (*v[:digit], value, *v[digit + 1 :])
            if eval(never, {"v": after}):
                continue
            own[f"o{number}"] = "State_" + "".join(after)
            if after not in known:
                known.add(after)
                queue.append(after)
    return table


def random_rules(
    chance: random.Random, start: tuple[str, ...], never: str
) -> tuple[str, list[list[PlainCase]]]:
    """A file of rules, and its cases in Python."""
    facts = ", ".join(f"{{name = '{name}', values = ['0', '1', '2']}}" for name in FACTS)
    text = f"facts = [{facts}]\nstart = {list(start)}\nnever = {json.dumps([never])}\n"
    cases: list[list[PlainCase]] = []
    for number in range(chance.randrange(1, 6)):
        own: list[str] = []
        cases.append([])
        for _ in range(chance.randrange(1, 4)):
            when, python = some_condition(chance, 2)
            digit, value = chance.randrange(3), chance.choice("012")
            change = f"{{'{list(FACTS)[digit]}' = '{value}'}}"
            own.append(f"{{when = {json.dumps(when)}, set = {change}}}")
            cases[-1].append((python, digit, value))
        text += f"[[rule]]\noperation = 'o{number}'\ncases = [{', '.join(own)}]\n"
    return text, cases


def test_random_rules_are_followed_as_a_plain_search_does() -> None:
    """States and operations are the same, and stand in the same order."""
    chance = random.Random(11)
    reached = set()
    for _ in range(60):
        never, python = some_condition(chance, 1)
        start = tuple(chance.choice("012") for _ in range(3))
        if eval(python, {"v": start}):
            continue
        text, cases = random_rules(chance, start, never)
        rows = ruled_branch(read_rules(text.encode(), "rules.toml")).values["SB1"]
        del rows["HEADER"]
        expected = plainly_followed(start, cases, python)
        assert [(one, list(row.items())) for one, row in rows.items()] == [
            (one, list(row.items())) for one, row in expected.items()
        ], text
        reached.add(len(rows))
    assert len(reached) > 5, "small and large ones"


def test_facts_with_many_values_and_many_facts_are_followed() -> None:
    """300 values do not fit into a byte, and 70 facts not into a number of 64 bits. A null
    character may end a value."""
    values = [f"{number:03}" for number in range(299)] + ["zz\0"]
    cases = [
        f'{{when = "n = {one}", set = {{n = {json.dumps(after)}}}}}'
        for one, after in itertools.pairwise(values)
    ]
    text = f"facts = [{{name = 'n', values = {json.dumps(values)}}}]\nstart = ['290']\n"
    text += f'[[rule]]\noperation = "up"\ncases = [{", ".join(cases)}]\n'
    rows = ruled_branch(read_rules(text.encode(), "rules.toml")).values["SB1"]
    assert len(rows) == 11
    assert (rows["State_298"], rows["State_zz\0"]) == ({"up": "State_zz\0"}, {})
    facts = ", ".join(f"{{name = 'f{n}', values = ['0', '1']}}" for n in range(70))
    text = f"facts = [{facts}]\nstart = {['0'] * 70}\n"
    for n in range(70):
        before = f"f{n - 1} = 1 and " if n else ""
        text += f'[[rule]]\noperation = "o{n}"\n'
        text += f'cases = [{{when = "{before}f{n} = 0", set = {{f{n} = "1"}}}}]\n'
    made = ruled_branch(read_rules(text.encode(), "rules.toml"))
    assert (made.states, made.operations) == (71, 70)
    assert f"State_{'1' * 70}" in made.values["SB1"]
