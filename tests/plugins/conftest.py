from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.plugins.hanoi_game import Game


@pytest.fixture(scope="module")
def game() -> Iterator[Game]:
    """One table with three disks; every test puts it up anew."""
    found = Game()
    yield found
    found.world.close()
