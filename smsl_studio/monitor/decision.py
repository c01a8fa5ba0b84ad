"""The decision about a fact from what its sources measure (paper, Eq. 5, ``F(sense(p, s))``).

The fact is decided at every look. Its clock is the run's, or the monotonic one if a source is
elsewhere. A measure stays as it is from its sample on, for the largest age of its source at most.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.measure import Measure
from smsl_studio.monitor.aggregate import Aggregate
from smsl_studio.monitor.clauses import Look, truth_of
from smsl_studio.monitor.speaker import HAIR

NO_SOURCE = "this world has no such source"
NEVER = "no reading yet"
TOLD = 3
"""The largest number of sources that a reason names."""


class Decider:
    """Makes the value of one fact from the measures of its sources.

    ``max_ages`` has the largest age (s) of a measure of each source that there is. Sources without
    one do not exist, so what needs them is unknown. All times are seconds of the fact's clock.
    """

    def __init__(self, sense: FactSense, max_ages: Mapping[str, float]) -> None:
        self.sense = sense
        self._places = {one.name: at for at, one in enumerate(sense.sources)}
        many = len(sense.sources)
        self._max_ages = [max_ages.get(one.name, 0.0) for one in sense.sources]
        self._longest = max(max_ages.values(), default=0.0)
        self._newest: list[Measure | None] = [None] * many
        self._whys = [NEVER if one.name in max_ages else NO_SOURCE for one in sense.sources]
        self._times = [-inf] * many
        """When the newest sample of each source came, good or not."""
        self._good = [-inf] * many
        """When the newest good sample of each source came."""
        self._look = Look(
            [None] * many, [None] * many, [one.name in max_ages for one in sense.sources]
        )
        self._last: tuple[str, float] | None = None
        """The value that was decided last, and when. None if the fact was unknown since."""
        self._truths = () if sense.fault else tuple(
            (one.value, truth_of(one.clause, sense, self._look)) for one in sense.predicates
        )  # fmt: skip

    def take(self, source: str, measure: Measure | None, at: float, reason: str = "") -> None:
        """Take the newest sample of a source, which came at ``at``. None says that it measures
        nothing, for a reason. A measure outside the range of the source is none either.
        """
        place = self._places[source]
        if measure is not None:
            reason = self._outside(place, measure)
        if reason or measure is None:
            self._newest[place], self._whys[place] = None, reason or "no valid reading"
        else:
            self._newest[place], self._good[place] = measure, at
        self._times[place] = at

    def look(self, now: float) -> Aggregate:
        """Return the value of the fact at ``now``, or None with the reason. Time never goes
        back."""
        if self.sense.fault is not None:
            return Aggregate(None, f"it cannot be decided: {self.sense.fault.sentence}")
        self._look.move(now, self._longest + HAIR)
        age = self._refresh(now)
        said = [(value, truth()) for value, truth in self._truths]
        found = self._verdict(said, age)
        if found.value is None:
            self._last = None
        return found

    def _refresh(self, now: float) -> float:
        """Find out which measures count now. Return the age of the oldest of them."""
        oldest = 0.0
        newest, present = self._newest, self._look.present
        times, ages = self._times, self._max_ages
        for place, measure in enumerate(newest):
            age = now - times[place]
            if age > ages[place] + HAIR:
                present[place] = None
            else:
                present[place] = measure
                if measure is not None and age > oldest:
                    oldest = age
            good = now - self._good[place]
            self._look.since_good[place] = good if good < inf else None
        return oldest

    def _verdict(self, said: list[tuple[str, bool | None]], age: float) -> Aggregate:
        true = [value for value, truth in said if truth]
        if len(true) > 1:
            words = " and ".join(true)
            return Aggregate(None, f"{len(true)} values are true at once: {words}", age, True)
        if any(truth is None for _, truth in said):
            return Aggregate(None, self._missing(), age)
        if true:
            self._last = true[0], self._look.now
            return Aggregate(true[0], "", age)
        if self._last is None:
            return Aggregate(None, "its measures mean none of its values", age)
        value, at = self._last
        held = self._look.now - at
        if held > self._longest + HAIR:
            words = f"its measures are between those of its values for {held:.1f} s"
            return Aggregate(None, words, age)
        return Aggregate(value, "", max(age, held))

    def _missing(self) -> str:
        """Return why it is not known which value is true."""
        reasons = []
        for place, spec in enumerate(self.sense.sources):
            if spec.valued and self._look.present[place] is None:
                reasons.append(f"{spec.name}: {self._why(place)}")
            elif not spec.valued and self._look.since_good[place] is None:
                reasons.append(f"{spec.name}: {self._whys[place]}")
        more = f"; and {len(reasons) - TOLD} more" if len(reasons) > TOLD else ""
        words = "; ".join(reasons[:TOLD]) + more
        return words or "it was not watched for long enough yet"

    def _why(self, place: int) -> str:
        age = self._look.now - self._times[place]
        if age == inf or (self._newest[place] is None and age <= self._max_ages[place] + HAIR):
            return self._whys[place]
        return f"no reading for {age:.1f} s"

    def _outside(self, place: int, measure: Measure) -> str:
        spec = self.sense.sources[place]
        numbers = measure if isinstance(measure, tuple) else (measure,)
        if spec.valued and isinstance(measure, tuple) != spec.position:
            return "it measures a position" if not spec.position else "it measures no position"
        for number in numbers:
            if not spec.low <= number <= spec.high:
                unit = "" if spec.unit.text == "1" else f" {spec.unit.text}"
                return f"{number:g}{unit} is outside {spec.low:g} to {spec.high:g}{unit}"
        return ""
