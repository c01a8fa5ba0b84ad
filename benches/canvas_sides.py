"""The two sides of the canvas bench: our canvas, and QGraphicsScene with one item for
everything."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import (
    QApplication,
    QGraphicsItem,
    QGraphicsLineItem,
    QGraphicsRectItem,
    QGraphicsScene,
    QGraphicsSimpleTextItem,
    QGraphicsView,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.theme import LIGHT

Size = tuple[int, int]


def _steady() -> None:
    QApplication.processEvents()


class Ours:
    """Our canvas."""

    def __init__(self, blueprint: Blueprint, size: Size) -> None:
        self._blueprint = blueprint
        self._places = place_states(blueprint["SB1"])
        self._names = list(self._places)
        self._turn = 0
        self.canvas = Canvas(LIGHT)
        self.canvas.camera.motion = False
        self.canvas.resize(*size)
        self.canvas.show()
        self.show()

    def show(self) -> None:
        self.canvas.show_branch(self._blueprint, "SB1", self._places)
        _steady()

    def before_fit(self) -> None:
        self.canvas.fit(smooth=False)
        _steady()

    def fit(self) -> None:
        self.canvas.viewport().repaint()

    def before_near(self) -> None:
        middle = self._places[self._names[len(self._names) // 2]]
        self.canvas.camera.go(QPointF(*middle), 1.0)
        _steady()

    near = fit

    def drag(self) -> None:
        self._turn += 1
        middle = len(self._names) // 2
        x, y = self._places[self._names[middle]]
        self.canvas.drag_states({middle: (x + 8.0 * (self._turn % 9), y)})
        _steady()

    def highlight(self) -> None:
        self._turn += 1
        name = self._names[len(self._names) // 2 + self._turn % 3]
        self.canvas.set_marks(Marks(selection=(Address("SB1", name),)))
        _steady()

    def close(self) -> None:
        self.canvas.close()


class _Node(QGraphicsRectItem):
    """A box with its name. Its lines move with it."""

    def __init__(self, name: str) -> None:
        super().__init__(-23.0, -12.0, 46.0, 24.0)
        self.lines: list[_Edge] = []
        self.setBrush(QColor("white"))
        self.setFlags(
            QGraphicsItem.GraphicsItemFlag.ItemIsMovable
            | QGraphicsItem.GraphicsItemFlag.ItemSendsGeometryChanges
        )
        text = QGraphicsSimpleTextItem(name.removeprefix("State_"), self)
        text.setPos(-20.0, -8.0)
        self.setZValue(1.0)


class _Edge(QGraphicsLineItem):
    """A line between two boxes with its label."""

    def __init__(self, a: _Node, b: _Node, name: str) -> None:
        super().__init__()
        self._ends = a, b
        a.lines.append(self)
        b.lines.append(self)
        self._label = QGraphicsSimpleTextItem(name, self)
        self.setPen(QPen(QColor("gray"), 1.0))
        self.follow()

    def follow(self) -> None:
        a, b = (node.pos() for node in self._ends)
        self.setLine(a.x(), a.y(), b.x(), b.y())
        self._label.setPos((a + b) / 2)


class Peer:
    """QGraphicsScene with an item for every node, edge and label."""

    def __init__(self, blueprint: Blueprint, size: Size) -> None:
        self._blueprint = blueprint
        self._places: Mapping[str, tuple[float, float]] = place_states(blueprint["SB1"])
        self._turn = 0
        self.view = QGraphicsView()
        self.view.setRenderHint(QPainter.RenderHint.Antialiasing)
        self.view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.view.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.view.resize(*size)
        self.view.show()
        self._nodes: dict[str, _Node] = {}
        self.show()

    def show(self) -> None:
        scene = QGraphicsScene(self.view)
        self._nodes = {}
        for name, (x, y) in self._places.items():
            node = self._nodes[name] = _Node(name)
            node.setPos(x, y)
            scene.addItem(node)
        for edge in self._blueprint["SB1"].edges():
            scene.addItem(_Edge(self._nodes[edge.source], self._nodes[edge.target], edge.name))
        self.view.setScene(scene)
        self.before_fit()

    def before_fit(self) -> None:
        rect: QRectF = self.view.scene().itemsBoundingRect()
        self.view.fitInView(rect, Qt.AspectRatioMode.KeepAspectRatio)
        _steady()

    def fit(self) -> None:
        self.view.viewport().repaint()

    def before_near(self) -> None:
        self.view.resetTransform()
        self.view.centerOn(self._middle())
        _steady()

    near = fit

    def drag(self) -> None:
        self._turn += 1
        x, y = self._places[self._middle_name()]
        node = self._nodes[self._middle_name()]
        node.setPos(x + 8.0 * (self._turn % 9), y)
        for line in node.lines:
            line.follow()
        _steady()

    def highlight(self) -> None:
        self._turn += 1
        names = list(self._nodes)
        for step in range(3):
            lit = self._turn % 3 == step
            node = self._nodes[names[len(names) // 2 + step]]
            node.setPen(QPen(QColor("blue" if lit else "gray"), 2.0 if lit else 1.0))
        _steady()

    def close(self) -> None:
        self.view.close()

    def _middle_name(self) -> str:
        return list(self._nodes)[len(self._nodes) // 2]

    def _middle(self) -> QPointF:
        return self._nodes[self._middle_name()].pos()
