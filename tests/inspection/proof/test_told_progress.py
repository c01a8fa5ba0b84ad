"""How far a search is, is told while configurations are explored one by one."""

from __future__ import annotations

import pytest

from smsl_studio.front.proof import proof_in, prove
from smsl_studio.inspection.proof.prove import Scope
from tests.inspection.proof.test_bounds import blueprint, counters

LINE = {f"S{n:02}": {"on": f"S{n + 1:02}"} for n in range(40)} | {"S40": {}}


@pytest.mark.parametrize(
    "values",
    [counters(2), {"_properties": [{"name": "far", "never": "A in S40 and A in S01"}], "A": LINE}],
    ids=["several SBs", "one SB"],
)
def test_the_number_grows_and_changes_no_answer(values: dict[str, object]) -> None:
    told: list[int] = []
    asked = blueprint(values)
    proof = proof_in(asked, Scope(small=10**9, tell=told.append))
    assert proof.verdicts == prove(asked).verdicts
    assert told == sorted(told)
    assert len(told) > 10
    assert 1 <= told[0] < told[-1] <= max(one.configurations or 0 for one in proof.verdicts)
