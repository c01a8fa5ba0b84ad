"""The decision about a fact from what its sources measure (paper, Eq. 5, ``F(sense(p, s))``).

The fact is decided at every look. Its clock is the run's, or the monotonic one if a source is
elsewhere. A measure stays as it is from its sample on, for the largest age of its source at most.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from smsl_studio.blueprint.check import Reading, fresh_reading, reading_of
from smsl_studio.blueprint.predicates import FactSense
from smsl_studio.blueprint.predicates.fact_sense import SourceSpec
from smsl_studio.blueprint.predicates.measure import Measure, measure_of
from smsl_studio.monitor.clauses import Look, PresentMeasure, truth_of
from smsl_studio.monitor.sample import GOOD, Sample
from smsl_studio.monitor.speaker import HAIR

NO_SOURCE = "this world has no such source"
NEVER = "no reading yet"
TOLD = 3
"""The largest number of sources that a reason names."""


class Heard(PresentMeasure):
    """What one source has measured: its newest ``sample`` that was taken, the ``newest`` measure if
    that is one, and when the sample came (``time``).

    ``most`` is the largest age (s) at which it counts. All times are seconds of the fact's clock.
    """

    __slots__ = (
        "_high",
        "_low",
        "_number",
        "_position",
        "_why",
        "most",
        "newest",
        "sample",
        "spec",
        "time",
    )

    def __init__(self, spec: SourceSpec, max_age: float | None) -> None:
        super().__init__(there=max_age is not None)
        self.spec = spec
        self._position = spec.position if spec.valued else None
        self._number, self._low, self._high = not spec.position, spec.low, spec.high
        self.sample: Sample | None = None
        self.most = (max_age or 0.0) + HAIR
        self.newest: Measure | None = None
        self.time = -inf
        self._why = NEVER if self.there else NO_SOURCE

    def take(self, sample: Sample, at: float) -> None:
        """Take the newest sample, which came at ``at``. A measure outside the range of the source
        is none."""
        self.sample, self.time = sample, at
        value = sample.value
        if value is None or sample.quality != GOOD:
            self.newest, self._why = None, sample.reason or f"its reading is {sample.quality}"
            return
        measure = measure_of(value, self._position)
        if type(measure) is float and self._number and self._low <= measure <= self._high:
            self.newest, self.good = measure, at
            return
        why = measure if isinstance(measure, str) else self._outside(measure)
        if why or isinstance(measure, str):
            self.newest, self._why = None, why
        else:
            self.newest, self.good = measure, at

    def doubt(self, reason: str, at: float) -> None:
        """Note at ``at`` that it is not known which sample counts, for a reason."""
        self.sample, self.newest, self._why, self.time = None, None, reason, at

    def count(self, now: float) -> float:
        """Make its measure present if it counts at ``now``. Return the age (s) of the measure, 0 if
        none counts."""
        age = now - self.time
        if age > self.most:
            self.present = None
            return 0.0
        self.present = measure = self.newest
        return 0.0 if measure is None else age

    def missing(self, now: float) -> str:
        """Return why it does not count at ``now``. An empty text means that it does."""
        spec = self.spec
        if not spec.valued:
            return "" if self.good is not None else f"{spec.name}: {self._why}"
        if self.present is not None:
            return ""
        age = now - self.time
        if age == inf or (self.newest is None and age <= self.most):
            return f"{spec.name}: {self._why}"
        return f"{spec.name}: no reading for {age:.1f} s"

    def _outside(self, measure: Measure) -> str:
        spec = self.spec
        numbers = measure if isinstance(measure, tuple) else (measure,)
        if spec.valued and isinstance(measure, tuple) != spec.position:
            return "it measures a position" if not spec.position else "it measures no position"
        for number in numbers:
            if not spec.low <= number <= spec.high:
                unit = "" if spec.unit.text == "1" else f" {spec.unit.text}"
                return f"{number:g}{unit} is outside {spec.low:g} to {spec.high:g}{unit}"
        return ""


class Decider:
    """Makes the value of one fact from the measures of its sources.

    ``max_ages`` has the largest age (s) of a measure of each source that there is. Sources without
    one do not exist, so what needs them is unknown. ``heard`` has the sources, in the order of the
    sense. All times are seconds of the fact's clock.
    """

    __slots__ = ("_fault", "_last", "_longest", "_look", "_truths", "heard")

    def __init__(self, sense: FactSense, max_ages: Mapping[str, float]) -> None:
        self._fault = sense.fault
        self.heard = {one.name: Heard(one, max_ages.get(one.name)) for one in sense.sources}
        self._longest = max(max_ages.values(), default=0.0) + HAIR
        self._look = Look(self.heard)
        self._last: tuple[str, float] | None = None
        """The value that was decided last, and when. None if the fact was unknown since."""
        self._truths = () if self._fault else tuple(
            (one.value, truth_of(one.clause, sense, self._look)) for one in sense.predicates
        )  # fmt: skip

    def look(self, now: float, age: float) -> Reading:
        """Return the value of the fact at ``now``, or None with the reason. Time never goes back.

        It is known which measures are ``present``, and ``age`` is that of the oldest of them.
        """
        look = self._look
        if look.began is None:
            look.began = look.now = now
        look.former = look.now if now - look.now > self._longest else None
        look.now = now
        true: tuple[str, ...] = ()
        known = not self._fault
        for value, truth in self._truths:
            found = truth()
            if found:
                true += (value,)
            elif found is None:
                known = False
        if known:
            if len(true) == 1:
                value = true[0]
                self._last = value, now
                return reading_of((value, "", age, True)) if age else fresh_reading(value)
            if not true and self._last is not None:
                value, at = self._last
                held = now - at
                if held <= self._longest:
                    age = held if held > age else age
                    return reading_of((value, "", age, True)) if age else fresh_reading(value)
        unknown = Reading(None, self._doubt(true, known, now), age)
        self._last = None
        return unknown

    def _doubt(self, true: tuple[str, ...], known: bool, now: float) -> str:
        """Return why the fact is unknown, where these values are true."""
        if self._fault is not None:
            return f"it cannot be decided: {self._fault.sentence}"
        if len(true) > 1:
            return f"{len(true)} values are true at once: {' and '.join(true)}"
        if not known:
            return self._missing(now)
        if self._last is None:
            return "its measures mean none of its values"
        held = now - self._last[1]
        return f"its measures are between those of its values for {held:.1f} s"

    def _missing(self, now: float) -> str:
        """Return why it is not known which value is true."""
        reasons = [why for one in self.heard.values() if (why := one.missing(now))]
        more = f"; and {len(reasons) - TOLD} more" if len(reasons) > TOLD else ""
        words = "; ".join(reasons[:TOLD]) + more
        return words or "it was not watched for long enough yet"
