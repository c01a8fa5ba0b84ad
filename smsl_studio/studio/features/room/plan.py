"""The plan of a room: walls, sterile zone, things and persons, and a tag for each node."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.front.sites.site_file import SiteNode, SiteRoom
from smsl_studio.front.views.room_view import (
    FRESH,
    SILENT,
    NodeTag,
    PersonMark,
    RoomView,
)
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.features.room.node_tags import dashed, ground_of, ink_of, paint_tag
from smsl_studio.studio.features.room.things import draw_patient, draw_thing

TAG_WIDE, TAG_HIGH, GAP = 130.0, 36.0, 10.0
WALL = 4.0
DISC = 15.0
STRETCH = 1.4
"""How much wider than deep a metre may be drawn where there is room beside."""
TABLE = 0.12, 0.34, 0.46, 0.26
"""The table in the sterile zone: x, y, width and height as shares of it."""


class RoomPlan(QWidget):
    """The plan. A click on a tag or a thing chooses its node, arrows the next one."""

    chosen = Signal(str)
    """str: the name of a node."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._room = SiteRoom()
        self._view: RoomView | None = None
        self._hidden: frozenset[str] = frozenset()
        self.node = ""
        """The name of the chosen node."""
        self.setMinimumSize(420, 240)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setAccessibleName("Plan of the room")

    def sizeHint(self) -> QSize:
        """The size in the design."""
        return QSize(1044, 480)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_room(self, view: RoomView, room: SiteRoom, hidden: Iterable[str], node: str) -> None:
        """Show a room. Nodes of the ``hidden`` kinds are left out, but never a silent one."""
        self._view, self._room, self._hidden = view, room, frozenset(hidden)
        self.node = node
        said = ", ".join(f"{one.title}: {one.words}" for one in view.nodes)
        self.setAccessibleDescription(plain_text(said))
        self.update()

    @property
    def tags(self) -> tuple[NodeTag, ...]:
        """The nodes that are shown."""
        nodes = self._view.nodes if self._view is not None else ()
        return tuple(one for one in nodes if one.kind not in self._hidden or one.standing == SILENT)

    def tag_place(self, name: str) -> QRectF:
        """Where the tag of a node is, in pixels."""
        return self._places()[name]

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the node of the tag or thing at the pointer."""
        self.setFocus()
        at = event.position()
        for name, place in self._places().items():
            if place.contains(at):
                self.chosen.emit(name)
                return
        for tag in self.tags:
            if tag.site is not None and (self._at(tag.site.place) - at).manhattanLength() < 40:
                self.chosen.emit(tag.name)
                return

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Left and Right choose the node before and after."""
        step = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        names = [one.name for one in self.tags]
        if step is None or not names:
            super().keyPressEvent(event)
            return
        at = names.index(self.node) if self.node in names else -1
        self.chosen.emit(names[(at + step) % len(names)])

    # Places.

    def _inside(self) -> QRectF:
        """The room between the rows of tags, in pixels. A low plan is drawn wider than it is."""
        free = QRectF(self.rect()).adjusted(24, 58, -24, -58)
        wide, deep = self._room.size
        scale = min(free.width() / wide, free.height() / deep)
        size = QRectF(0, 0, min(free.width(), wide * scale * STRETCH), deep * scale)
        size.moveCenter(free.center())
        return size

    def _at(self, place: tuple[float, float]) -> QPointF:
        inside = self._inside()
        return QPointF(
            inside.left() + place[0] / self._room.size[0] * inside.width(),
            inside.top() + place[1] / self._room.size[1] * inside.height(),
        )

    def _places(self) -> dict[str, QRectF]:
        """The tags: those of the upper half at the upper wall, the others at the lower one, in the
        order of their places. A row that is full gives to the other one."""
        tags = self.tags
        across = int((self.width() - 32 + GAP) // (TAG_WIDE + GAP)) or 1
        rows: tuple[list[NodeTag], list[NodeTag]] = ([], [])
        for at, tag in enumerate(tags):
            low = (
                tag.site.place[1] > self._room.size[1] / 2 if tag.site is not None else at % 2 == 1
            )
            rows[low if len(rows[low]) < across else not low].append(tag)
        found: dict[str, QRectF] = {}
        for row, top in zip(rows, (14.0, self.height() - 14.0 - TAG_HIGH), strict=True):
            row.sort(key=lambda one: one.site.place[0] if one.site is not None else 0.0)
            slot = (self.width() - 32.0) / max(len(row), 1)
            wide = min(TAG_WIDE, slot - 4)
            for at, tag in enumerate(row):
                left = 16 + slot * at + (slot - wide) / 2
                found[tag.name] = QRectF(left, top, wide, TAG_HIGH)
        return found

    # Painting.

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the floor, then the nodes with their tags, then what is chosen."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        tokens = self._tokens
        painter.fillRect(self.rect(), tokens.surf)
        painter.setPen(QPen(tokens.tx2, WALL))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(4, 4, -4, -4), 3, 3)
        view = self._view
        if view is None:
            return
        self._zone(painter)
        self._scale(painter)
        places = self._places()
        for tag in self.tags:
            self._reach(painter, tag)
        for tag in self.tags:
            self._line(painter, tag, places[tag.name])
        for tag in self.tags:
            self._thing(painter, tag)
        for person in view.persons:
            self._person(painter, person)
        for tag in self.tags:
            paint_tag(painter, tag, places[tag.name], tag.name == self.node, tokens)

    def _zone(self, painter: QPainter) -> None:
        if self._room.sterile is None:
            return
        tokens = self._tokens
        x, y, wide, deep = self._room.sterile
        zone = QRectF(self._at((x, y)), self._at((x + wide, y + deep)))
        painter.setPen(dashed(tokens.ok, 1.4))
        painter.setBrush(tokens.canvas)
        painter.drawRoundedRect(zone, 6, 6)
        a, b, c, d = TABLE
        table = QRectF(
            zone.left() + a * zone.width(), zone.top() + b * zone.height(),
            c * zone.width(), d * zone.height(),
        )  # fmt: skip
        draw_patient(painter, table, tokens.nl, tokens.sunk)
        words = QRectF(zone.right() - 130, zone.top() - 18, 126, 16)
        paint_text(painter, words, "sterile zone", TextInk(tokens.ok, 11), right=True)
        words = QRectF(table.right() - 60, table.bottom() - 18, 54, 16)
        paint_text(painter, words, "Patient", TextInk(tokens.tx2, 11), right=True)

    def _below(self, at: QPointF) -> QColor:
        """The colour of the floor at a point."""
        tokens, zone = self._tokens, self._room.sterile
        if zone is None:
            return tokens.surf
        x, y, wide, deep = zone
        inside = QRectF(self._at((x, y)), self._at((x + wide, y + deep))).contains(at)
        return tokens.canvas if inside else tokens.surf

    def _scale(self, painter: QPainter) -> None:
        tokens, inside = self._tokens, self._inside()
        metre = inside.width() / self._room.size[0]
        at = QPointF(inside.left() + 0.3 * metre, inside.bottom() - 8)
        painter.setPen(QPen(tokens.tx2, 1.4))
        painter.drawLine(at, at + QPointF(metre, 0))
        words = QRectF(at.x(), at.y() - 18, metre, 16)
        paint_text(painter, words, "1 m", TextInk(tokens.tx2, 11))

    def _reach(self, painter: QPainter, tag: NodeTag) -> None:
        node = tag.site
        if node is None or not node.reach:
            return
        tokens, at = self._tokens, self._at(node.place)
        metre = self._inside().width() / self._room.size[0]
        ink = tokens.acc if tag.standing == FRESH else ink_of(tag, tokens)
        if node.draws == "tracker":
            far = node.reach * metre
            wedge = QPolygonF([at, at + QPointF(-far, -0.12 * far), at + QPointF(-far, 0.3 * far)])
            ground = QColor(tokens.accs)
            ground.setAlpha(150 if tag.standing == FRESH else 0)
            painter.setPen(dashed(ink, 1.2))
            painter.setBrush(ground)
            painter.drawPolygon(wedge)
            return
        painter.setPen(QPen(ink, 1, Qt.PenStyle.DotLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(at, max(node.reach * metre, 48), max(node.reach * metre, 48))

    def _line(self, painter: QPainter, tag: NodeTag, place: QRectF) -> None:
        if tag.site is None:
            return
        at = self._at(tag.site.place)
        upper = place.top() < self.height() / 2
        begin = QPointF(place.center().x(), place.bottom() if upper else place.top())
        bend = QPointF(begin.x(), at.y()) if abs(begin.x() - at.x()) > 2 else at
        fresh = tag.standing == FRESH
        tokens = self._tokens
        ink = tokens.acc if tag.name == self.node else tokens.nl
        painter.setPen(QPen(ink if fresh else ink_of(tag, tokens), 1.2))
        painter.drawPolyline(QPolygonF([begin, bend, at]))

    def _thing(self, painter: QPainter, tag: NodeTag) -> None:
        node = tag.site
        if node is None:
            return
        tokens, at = self._tokens, self._at(node.place)
        fresh = tag.standing == FRESH
        ink = tokens.tx2 if fresh else ink_of(tag, tokens)
        ground = tokens.surf if fresh else ground_of(tag, tokens)
        painter.setPen(QPen(ink, 1.4) if fresh else dashed(ink, 1.4))
        draw_thing(painter, node.draws, at, ink, ground)
        if node.draws == "tray":
            self._tray(painter, tag, node, at)
        if tag.name == self.node:
            painter.setPen(QPen(tokens.acc, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            wide, deep = (48, 28) if node.draws in ("tray", "arm") else (20, 22)
            ring = QRectF(at.x() - wide, at.y() - deep, 2 * wide, 2 * deep)
            painter.drawRoundedRect(ring, 8, 8)

    def _tray(self, painter: QPainter, tag: NodeTag, node: SiteNode, at: QPointF) -> None:
        """The slots of a tray: a filled square is a tag that is read, a dashed slot one that is
        not. A reader that is silent leaves all of them hatched."""
        tokens = self._tokens
        counts = [one.said.value for one in tag.sources if one.said.source == "tags_read"]
        read = _count(counts[0]) if counts else None
        for slot in range(node.tags):
            box = QRectF(at.x() - 34 + slot * (68 / max(node.tags, 1)), at.y() - 13, 12, 26)
            if read is None:
                painter.setPen(dashed(tokens.unk, 1))
                painter.setBrush(Qt.BrushStyle.BDiagPattern)
            elif slot < node.tags - read:
                painter.setPen(dashed(tokens.acc, 1.2))
                painter.setBrush(tokens.accs)
            else:
                painter.setPen(QPen(tokens.tx2, 1))
                painter.setBrush(tokens.surf)
            painter.drawRoundedRect(box, 3, 3)
            if read is not None and slot >= node.tags - read:
                painter.fillRect(QRectF(box.center().x() - 3, box.top() + 4, 6, 6), tokens.slate)
        words = "tags not known" if read is None else f"{read} of {node.tags} tags read"
        room = QRectF(at.x() - 70, at.y() - 42, 140, 16)
        painter.setFont(text_font(11, 400))
        painter.setPen(tokens.unk if read is None else tokens.tx)
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter, words)

    def _person(self, painter: QPainter, mark: PersonMark) -> None:
        tokens, at = self._tokens, self._at(mark.site.place)
        unknown = mark.words == "not known"
        gone = mark.here is False
        ink = tokens.unk if unknown else tokens.tx3 if gone else tokens.tx2
        if mark.here and mark.sterile:
            ink = tokens.ok
        painter.setPen(dashed(ink, 1.4) if unknown or gone else QPen(ink, 1.6))
        painter.setBrush(tokens.oks if ink == tokens.ok else tokens.surf)
        painter.drawEllipse(at, DISC, DISC)
        box = QRectF(at.x() - 8, at.y() - 8, 16, 16)
        if unknown:
            painter.setFont(mono_font(13, 600))
            painter.setPen(ink)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, "?")
        elif not gone:
            draw(painter, "person", box, ink, tokens.surf)
        painter.setFont(text_font(11, 600))
        painter.setPen(tokens.tx)
        centre = Qt.AlignmentFlag.AlignCenter
        name = QRectF(at.x() - 80, at.y() + DISC + 2, 160, 15)
        title = plain_text(mark.title)
        # A line that passes below the words would make them hard to read.
        wide = painter.fontMetrics().horizontalAdvance(title) + 4
        painter.fillRect(QRectF(at.x() - wide / 2, name.top(), wide, 28), self._below(at))
        painter.drawText(name, centre, title)
        painter.setFont(text_font(11, 400))
        painter.setPen(ink)
        painter.drawText(name.translated(0, 14), centre, mark.words)


def _count(text: str | None) -> int | None:
    """A number of things, None if it is none."""
    try:
        number = float(text) if text is not None else -1.0
    except ValueError:
        return None
    return int(number) if 0 <= number < 1000 else None
