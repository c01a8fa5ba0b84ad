"""The garbage collector is off while a file is read; afterwards it is as it was before."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.smsl.files import parse_bytes
from smsl_studio.smsl.garbage import uncollected


@pytest.fixture(autouse=True)
def _switched_on() -> Iterator[None]:
    gc.enable()
    yield
    gc.enable()


def test_nothing_is_collected_within_and_again_behind() -> None:
    with uncollected():
        with uncollected():
            assert not gc.isenabled()
        assert not gc.isenabled()
    assert gc.isenabled()


def test_a_fault_switches_it_on_again() -> None:
    with pytest.raises(ReadError):
        parse_bytes(b"{", "a.json")
    assert gc.isenabled()


def test_where_somebody_switched_it_off_it_stays_off() -> None:
    gc.disable()
    with uncollected():
        pass
    assert not gc.isenabled()


def test_the_last_of_several_threads_switches_it_on() -> None:
    both = Barrier(2, timeout=60)

    def read(_: int) -> None:
        with uncollected():
            both.wait()
            assert not gc.isenabled()
            both.wait()

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(read, range(2)))
    assert gc.isenabled()
