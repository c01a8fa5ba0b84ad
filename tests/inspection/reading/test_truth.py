"""No sentence of a reading is false: random blueprints are judged by plain steps."""

from __future__ import annotations

from collections import Counter

from tests.inspection.reading.judged_reading import judge

SOME = 100


def test_what_the_reading_of_a_random_blueprint_tells_is_true() -> None:
    found: Counter[str] = Counter()
    for number in range(SOME):
        found.update(judge(number))
    # Each kind of sentence was met, so none is true only because it was never written.
    assert set(found) >= {"steps", "instead", "orders", "others", "hazards"}
