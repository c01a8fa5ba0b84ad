"""Choosing a thing in the picture of a world."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.studio.running.scene.things_seen import thing_at
from smsl_studio.world.protocol import Shape


def test_the_smallest_thing_at_a_point_is_meant() -> None:
    def thing(name: str, *box: float) -> tuple[Shape, QRectF]:
        return Shape(name, (), (0.0, 0.0, 0.0)), QRectF(*box)

    seen = [thing("ground", 0, 0, 200, 100), thing("cup", 50, 50, 10, 20)]
    assert thing_at(QPointF(55, 60), seen) == "cup"
    assert thing_at(QPointF(47, 60), seen) == "cup", "a few pixels beside it still mean it"
    assert thing_at(QPointF(20, 20), seen) == "ground"
    assert thing_at(QPointF(300, 20), seen) == ""
