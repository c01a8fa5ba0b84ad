"""Several cases in one test: a failure names the case."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def case(*names: object) -> Iterator[None]:
    """Add the name of this case to a failure in it.

    To collect and prepare a test takes about 10 ms of a processor, and a window 300 ms. So many
    cheap cases share one test, and several cases share one window.
    """
    try:
        yield
    except Exception as error:
        error.add_note(f"In the case {' '.join(map(str, names))}")
        raise
