"""The oracle finds deliberate faults, for each clause."""

from __future__ import annotations

import pytest

from tests.oracle.faults import FAULTS, Fault
from tests.oracle.judged import judged


def test_every_clause_is_broken_in_some_way() -> None:
    assert {fault.clause for fault in FAULTS} == set(range(1, 17))
    assert all(fault.numbers for fault in FAULTS)


@pytest.mark.parametrize("fault", FAULTS, ids=str)
def test_the_oracle_names_the_clause_that_is_broken(
    fault: Fault, monkeypatch: pytest.MonkeyPatch
) -> None:
    for number in fault.numbers:
        assert judged(number).findings == ()
    fault.apply(monkeypatch)
    for number in fault.numbers:
        named = {finding.split(" broken")[0] for finding in judged(number).findings}
        assert f"clause {fault.clause}" in named
