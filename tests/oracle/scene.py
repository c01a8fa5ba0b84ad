"""The value of every fact, computed from samples and answers alone: clause 13.

A sample counts if it is newer than the ones before and was not delayed too long; it ages in
simulated time. A value is True, False or None (unknown).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from tests.oracle.drawing import Drawing

MAX_AGE = 0.3
"""Seconds for which a reading counts where nothing else is declared."""
HAIR = 1e-6
BELIEVED = object()
"""The reading of a fact that nobody senses."""


class _Source:
    def __init__(self, max_age: float) -> None:
        self.max_age = max_age
        self.value: str | None = None
        self.at: float | None = None
        self.order = (-1, -1)
        self.quickest = float("inf")
        self.boot = -1
        self.fresh = True
        self.doubted = float("-inf")

    def take(self, sample: list[Any], now: float) -> None:
        _, _, value, quality, boot, sequence, time = sample
        if (boot, sequence) <= self.order:
            return
        self.order = (boot, sequence)
        if boot != self.boot:
            self.boot, self.quickest = boot, float("inf")
        way = now - time
        self.quickest = min(self.quickest, way)
        if way - self.quickest > self.max_age + HAIR:
            return
        self.value = value if quality == "good" else None
        self.at = now
        # What was read before the doubt tells nothing of what came after it.
        self.fresh = self.fresh or time >= self.doubted

    def says(self, now: float) -> str | None:
        return self._stands(now) if self.fresh else None

    def doubt(self, now: float) -> None:
        """What it says counts no longer, until it says it anew; who says nothing owes nothing.

        Regulation 3: a fact of several sources is made by its aggregation of those that speak.
        """
        self.fresh, self.doubted = self._stands(now) is None, now

    def forget(self, now: float) -> None:
        """What it had to say anew has grown old: it says nothing now, as any silent source."""
        self.fresh = self.fresh or self._stands(now) is None

    def _stands(self, now: float) -> str | None:
        """Its last reading, None where that is too old."""
        if self.at is None or now - self.at > self.max_age + HAIR:
            return None
        return self.value


class Scene:
    """The facts of one run as they are sensed."""

    def __init__(self, drawing: Drawing, world: Mapping[str, Any]) -> None:
        self._drawing = drawing
        self.now = 0.0
        self._sources: dict[str, dict[str, _Source]] = {}
        self._answers: dict[str, tuple[str, float]] = {}
        self._agreed: dict[str, tuple[str, float]] = {}
        self._doubted: set[str] = set()
        eyes = world.get("eyes", {})
        for fact in drawing.leaves:
            sources: dict[str, _Source] = {}
            name, digit = fact.rsplit("/", 1)
            if fact not in world.get("blind", ()):
                age = drawing.fact_note(fact).get("max_age") or MAX_AGE
                sources[f"table_{name}_{digit}"] = _Source(float(age))
            if fact in eyes:
                sources[f"eye_{name}_{digit}"] = _Source(MAX_AGE)
            self._sources[fact] = sources
        self._ruled = set(eyes)
        self._known: dict[str, Any] = {}
        self._earlier: list[dict[str, Any]] = []

    def begin_part(self) -> None:
        """What was known before this point of a tick does not count any more."""
        self._earlier = []

    def hear(self, samples: Iterable[list[Any]], now: float) -> None:
        """Samples that came in at ``now``."""
        self.now = now
        self._earlier.append(dict(self._known))
        for sample in samples:
            source = self._sources[sample[0]].get(sample[1])
            if source is not None:
                source.take(sample, now)
        self._known = {}
        for fact in self._drawing.leaves:
            self._known[fact] = self._read(fact)

    def moments(self) -> Iterator[None]:
        """Let the scene be, one after the other, each that was known in this part of a tick."""
        last = self._known
        for known in (*filter(None, self._earlier), last):
            self._known = known
            yield
        self._known = last

    def answer(self, fact: str, value: str | None) -> None:
        """A person says what a fact is; None takes back what was said."""
        if value is None:
            self._answers.pop(fact, None)
        else:
            self._answers[fact] = (value, self.now)
            self._doubted.discard(fact)
        self._known[fact] = self._read(fact)

    def forget(self, facts: Iterable[str]) -> None:
        """What a person said of facts is over: an operation changes them."""
        for fact in facts:
            if self._answers.pop(fact, None) is not None:
                self._known[fact] = self._read(fact)

    def forget_people(self) -> None:
        """What people said of facts is over: somebody has taken over."""
        self.forget(list(self._answers))

    def doubt(self, facts: Iterable[str]) -> None:
        """Facts that a cancelled operation may have moved: unknown until all say them anew."""
        for fact in facts:
            for source in self._sources[fact].values():
                source.doubt(self.now)
            if not self._sources[fact] and self._drawing.fact_level(fact) == "automatic":
                self._doubted.add(fact)
            self._known[fact] = self._read(fact)

    def trust(self) -> None:
        """A person adopts where the procedure stands: what nobody senses is believed again."""
        for fact in self._doubted:
            self._known[fact] = BELIEVED
        self._doubted.clear()

    def reading(self, fact: str) -> Any:
        """The value of a fact, None where it is unknown, BELIEVED where nobody senses it."""
        return self._known.get(fact)

    def in_doubt(self, fact: str) -> bool:
        """Whether it is unknown because a cancelled operation may have moved it."""
        return fact in self._doubted or not all(s.fresh for s in self._sources[fact].values())

    def has_sensors(self, fact: str) -> bool:
        """Whether a sensor reads it."""
        return bool(self._sources[fact])

    def is_sensed(self, fact: str) -> bool:
        return bool(self._sources[fact]) or self._drawing.fact_level(fact) != "automatic"

    def says(self, fact: str, value: str, believed: Mapping[str, str]) -> bool | None:
        """Whether a leaf fact has a value; what nobody senses is as ``believed`` has it."""
        found = self._known.get(fact)
        if found is BELIEVED:
            name, digit = fact.rsplit("/", 1)
            found = self._drawing.value(believed[name], name, int(digit))
        return None if found is None else bool(found == value)

    def check(self, name: str, state: str, believed: Mapping[str, str]) -> bool | None:
        """The state check in three values; a digit that a sub-SB expands is the sub's check."""
        branch = self._drawing.branches[name]
        results = [self.own_check(name, state, believed)]
        for digit, sub in branch.subs.items():
            there = self.check(sub, self._drawing.branches[sub].activating, believed)
            on = branch.is_on(state, digit)
            results.append(there if on or there is None else not there)
        return all_of(results)

    def own_check(self, name: str, state: str, believed: Mapping[str, str]) -> bool | None:
        """The state check of an SB without the digits that sub-SBs expand."""
        facts = self._drawing.branches[name].facts[state]
        leaves = self._drawing.branches[name].leaves
        return all_of([self.says(f"{name}/{one}", facts[one], believed) for one in leaves])

    def mismatches(self, believed: Mapping[str, str]) -> set[str]:
        """The sensed facts that are known and not what a configuration says."""
        found = set()
        for fact in self._drawing.leaves:
            name, digit = fact.rsplit("/", 1)
            value = self._drawing.value(believed[name], name, int(digit))
            if self.says(fact, value, believed) is False:
                found.add(fact)
        return found

    def agrees(self, believed: Mapping[str, str], trusting: bool = False) -> bool:
        """Whether every sensed fact is known and as a configuration says.

        ``trusting``: a fact that nobody senses, and that is in doubt, is let pass; a person
        decides about it.
        """
        if not trusting or not self._doubted:
            return all(
                self.own_check(name, state, believed) is True for name, state in believed.items()
            )
        kept = dict(self._known)
        self._known.update(dict.fromkeys(self._doubted, BELIEVED))
        found = self.agrees(believed)
        self._known = kept
        return found

    def agreed(self, believed: Mapping[str, str], trusting: bool = False) -> bool:
        """Whether it agrees now, or did when sensors were read before in this part of the tick."""
        kept = self._known
        for known in (kept, *self._earlier):
            self._known = known
            found = self.agrees(believed, trusting)
            self._known = kept
            if found:
                return True
        return False

    def _read(self, fact: str) -> Any:
        level = self._drawing.fact_level(fact)
        sources = self._sources[fact]
        if fact in self._doubted:
            return None
        if level == "human":
            return self._answered(fact)
        if not sources:
            return self._answered(fact) if level == "shared" else BELIEVED
        for source in sources.values():
            source.forget(self.now)
        said = None
        if all(source.fresh for source in sources.values()):
            said = self._agreement(fact, [source.says(self.now) for source in sources.values()])
        if said is None and level == "shared":
            return self._answered(fact)
        return said

    def _answered(self, fact: str) -> str | None:
        if fact not in self._answers:
            return None
        value, at = self._answers[fact]
        note = self._drawing.fact_note(fact)
        limit = note.get("max_age") if note.get("aggregation") == "human" else None
        return None if limit is not None and self.now - at > limit + HAIR else value

    def _agreement(self, fact: str, said: list[str | None]) -> str | None:
        """Several sources become one value as ``aggregation`` says; disagreement is unknown."""
        note = self._drawing.fact_note(fact) if fact in self._ruled else {}
        valid = [one for one in said if one is not None]
        differ = len(set(valid)) > 1
        rule = note.get("aggregation") or "single"
        value: str | None
        if rule == "all":
            value = valid[0] if len(valid) == len(said) and not differ else None
        elif rule == "k_of_n":
            k = note.get("k") or len(said)
            enough = [one for one, number in Counter(valid).items() if number >= k]
            fine = len(enough) == 1 and not (differ and note.get("critical"))
            value = enough[0] if fine else None
        elif rule == "priority":
            fine = bool(valid) and not (differ and note.get("critical"))
            value = valid[0] if fine else None
        else:
            value = valid[0] if valid and not differ else None
        patience = note.get("conflict_after", 0.0)
        if not differ or value is not None:
            if value is not None:
                self._agreed[fact] = (value, self.now)
            else:
                self._agreed.pop(fact, None)
            return value
        agreed = self._agreed.get(fact)
        if agreed and agreed[0] in valid and self.now - agreed[1] <= patience + HAIR:
            return agreed[0] if patience else None
        self._agreed.pop(fact, None)
        return None


def all_of(results: Iterable[bool | None]) -> bool | None:
    """AND in three values."""
    found: bool | None = True
    for one in results:
        if one is False:
            return False
        if one is None:
            found = None
    return found
