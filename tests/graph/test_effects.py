"""The effects of all edges: computed in arrays and one by one, against a plain count."""

from __future__ import annotations

from collections import Counter
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph import effects as home
from smsl_studio.graph.effects import effects_of
from tests.counts import share_of
from tests.inspection.intact import read

ALPHABETS = ("01", "abc", ("aa", "ab", "ba"), "0é\U0001f600", ("x", "yy", "zzz"))


def drawn_branch(seed: int) -> StateBranch:
    drawn = Random(seed)
    alphabet = ALPHABETS[seed % len(ALPHABETS)]
    count = drawn.randrange(1, 5)
    rows = {tuple(drawn.choice(alphabet) for _ in range(count)) for _ in range(12)}
    given = alphabet == ALPHABETS[-1]
    names = {
        row: f"n{number}" if given else f"State_{''.join(row)}"
        for number, row in enumerate(sorted(rows))
    }
    known = list(names.values())
    values: dict[str, Any] = {"HEADER": {"NUM_FACTS": count}}
    if given:
        values["_states"] = {name: {"facts": list(row)} for row, name in names.items()}
    for name in known:
        targets = [*known, "nowhere"] if seed % 3 == 0 else known
        out = {f"o{drawn.randrange(4)}": drawn.choice(targets) for _ in range(3)}
        values[name] = out
    return read({"SB": values})["SB"]


def plain(branch: StateBranch) -> list[tuple[str, str, frozenset[tuple[int, str]]]]:
    found = []
    for state, out in branch.table.items():
        for name, target in out.items():
            if target in branch.table:
                pairs = enumerate(zip(branch.facts(state), branch.facts(target), strict=True))
                found.append((state, name, frozenset((d, b) for d, (a, b) in pairs if a != b)))
    return found


@pytest.mark.parametrize("arrays", [False, True])
@pytest.mark.parametrize("seed", range(share_of(60)))
def test_effects_are_those_of_a_plain_count(
    seed: int, arrays: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(home, "MANY", 0 if arrays else 10**9)
    branch = drawn_branch(seed)
    effects = effects_of(branch)
    edges = [effects.edge(number) for number in range(len(effects.of))]
    expected = plain(branch)
    pairs = zip(edges, effects.of, strict=True)
    found = [(edge.source, edge.name, frozenset(effects.kinds[kind])) for edge, kind in pairs]
    assert found == expected
    assert list(dict.fromkeys(effects.of)) == list(range(len(effects.kinds)))
    ends = {(edge.source, edge.target) for edge in edges}
    alone = [n for n, edge in enumerate(edges) if (edge.target, edge.source) not in ends]
    assert list(effects.one_way) == alone
    for name, most in effects.majority.items():
        own = Counter(one for _, operation, one in expected if operation == name)
        held = [one for one, count in own.items() if 2 * count > own.total()]
        assert ([frozenset(most)] if most is not None else []) == held
