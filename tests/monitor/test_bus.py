"""The fact bus hands on the newest samples, is bounded in every flood, and counts lost samples."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.monitor.bus import MOST_SOURCES, BusCounts, FactBus
from smsl_studio.monitor.sample import LONGEST, Sample


def _sample(source: str = "eye", sequence: int = 1, boot: int = 0, value: str = "1") -> Sample:
    return Sample("SB1", 0, source, value, 0.0, sequence, boot)


def test_everyone_who_subscribed_hears_everything_once() -> None:
    bus = FactBus()
    bus.publish([_sample("too early")])
    first, second = bus.subscribe(), bus.subscribe()
    said = [_sample("eye"), _sample("ear")]
    bus.publish(said)
    assert first.take() == second.take() == tuple(said)
    assert first.take() == ()
    second.close()
    second.close()
    bus.publish(said)
    assert (len(first.take()), second.take()) == (2, ())


def test_a_flood_costs_its_own_samples_only() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish([_sample("ear")])
    bus.publish(_sample("eye", sequence) for sequence in range(5000))
    assert [(one.source, one.sequence) for one in inbox.take()] == [("ear", 1), ("eye", 4999)]
    assert bus.counts == BusCounts(published=5001, replaced=4999)
    assert (bus.replaced(("SB1", 0), "eye"), bus.replaced(("SB1", 0), "ear")) == (4999, 0)


def test_a_flood_of_sources_is_refused() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish(_sample(f"s{n}") for n in range(MOST_SOURCES + 10))
    assert len(inbox.take()) == MOST_SOURCES
    assert bus.counts.refused == 10
    bus.publish(_sample(f"s{n % (2 * MOST_SOURCES)}", n) for n in range(MOST_SOURCES))
    assert len(inbox.take()) == MOST_SOURCES


def test_what_is_too_long_or_retained_is_only_counted() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish([_sample(value="x" * (LONGEST + 1)), _sample("x" * (LONGEST + 1))])
    bus.publish([_sample()], retained=True)
    assert inbox.take() == ()
    assert bus.counts == BusCounts(published=3, refused=2, retained=1)


@given(st.lists(st.tuples(st.sampled_from("ab"), st.integers(0, 2), st.integers(0, 4)), max_size=9))
def test_the_newest_of_each_speaker_waits(came: list[tuple[str, int, int]]) -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    for source, boot, sequence in came:
        bus.publish([_sample(source, sequence, boot)])
    newest = {one[:2]: max(two[2] for two in came if two[:2] == one[:2]) for one in came}
    waiting = inbox.take()
    assert {(one.source, one.boot): one.sequence for one in waiting} == newest
    assert len(waiting) == len(newest)
    assert bus.counts.replaced == len(came) - len(newest)


class _WatchedLock:
    """A lock that counts how often it was taken."""

    def __init__(self) -> None:
        self.taken = 0
        self._lock = threading.Lock()

    def __enter__(self) -> None:
        self._lock.acquire()
        self.taken += 1

    def __exit__(self, *_: object) -> None:
        self._lock.release()


def test_whatever_threads_share_is_behind_the_lock() -> None:
    bus = FactBus()
    lock = _WatchedLock()
    bus.lock = lock  # type: ignore[assignment]
    inbox = bus.subscribe()
    uses: list[Callable[[], object]] = [
        bus.subscribe,
        lambda: bus.publish([_sample()]),
        inbox.take,
        lambda: bus.counts,
        lambda: bus.replaced(("SB1", 0), "eye"),
        inbox.close,
    ]
    for use in uses:
        before = lock.taken
        use()
        assert lock.taken == before + 1


def test_any_thread_may_publish() -> None:
    bus = FactBus()
    inbox = bus.subscribe()

    def watched() -> Iterator[Sample]:
        assert bus.lock.locked()
        yield _sample("a", 0)

    bus.publish(watched())

    def speak(name: str) -> None:
        for sequence in range(300):
            bus.publish([_sample(name, sequence)])

    threads = [threading.Thread(target=speak, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted((one.source, one.sequence) for one in inbox.take()) == [
        (name, 299) for name in "abcd"
    ]
    assert bus.counts.published == 1201


def test_a_repeated_source_among_the_first_samples_waits_once() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish([_sample("eye", 1), _sample("ear", 1), _sample("eye", 2)])
    assert [(one.source, one.sequence) for one in inbox.take()] == [("eye", 2), ("ear", 1)]
    assert bus.counts == BusCounts(published=3, replaced=1)
    bus.publish([_sample("eye", 3)])
    bus.publish([_sample("eye", 4), _sample("ear", 2)])
    assert [(one.source, one.sequence) for one in inbox.take()] == [("eye", 4), ("ear", 2)]
    assert bus.counts == BusCounts(published=6, replaced=2)


def test_texts_that_are_long_only_together_are_not_refused() -> None:
    bus = FactBus()
    inbox = bus.subscribe()
    bus.publish([_sample("s" * LONGEST, value="v" * LONGEST), _sample()])
    assert len(inbox.take()) == 2
    assert bus.counts.refused == 0
