"""What the node of a state shows if it has far more facts than fit in it."""

from __future__ import annotations

from smsl_studio.picture.figure import CHIP, GAP, WIDEST
from smsl_studio.picture.picture import MOST_CHIPS, Picture
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import read, steps


def test_a_node_has_no_more_chips_than_it_has_room_for() -> None:
    picture = Picture(read(BY_NAME["long_states"], "json", 100_000), "B")
    face = picture.face(0)
    assert len(face.chips) == MOST_CHIPS >= WIDEST / (CHIP + GAP)
    assert face.short.startswith("0" * (MOST_CHIPS // 2) + "…")
    assert face.short.endswith(picture.names[0][-MOST_CHIPS // 2 :])


def test_a_face_takes_the_same_work_however_many_facts_there_are() -> None:
    def work(size: int) -> int:
        picture = Picture(read(BY_NAME["known_subs"], "json", size), "A")
        picture.face(0)  # what is known of the SB is worked out once
        return steps(lambda: picture.face(1))

    assert work(40_000) <= 2 * work(2_000)
