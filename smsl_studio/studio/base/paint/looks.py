"""Looks: from marks and the pointer to the look of each node and edge."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.paint.edge_paint import EdgeLook
from smsl_studio.studio.base.paint.node_paint import NodeLook


class Looks:
    """The look of every state and edge by number. Only highlighted ones are stored."""

    def __init__(self, picture: Picture, marks: Marks) -> None:
        self._picture = picture
        self.marks = marks
        self.hovered_state, self.hovered_edge = -1, -1
        self.shown_bundle = -1
        """An edge of the bundle whose card is open, -1 for none."""
        self.quiet: frozenset[int] = frozenset()
        """The edges that are dimmed while nothing highlights them."""
        self._spot: frozenset[int] | None = None
        """The states that are not dimmed while one state of a collapsed drawing is selected."""
        self._nodes: dict[int, NodeLook] = {}
        self._edges: dict[int, EdgeLook] = {}
        self._guards: dict[int, str] = {}
        self._read(marks)

    @property
    def lit_states(self) -> list[int]:
        """The highlighted states; their nodes are never smaller than compact."""
        return [i for i, look in self._nodes.items() if look.lit]

    @property
    def marked_states(self) -> list[int]:
        """The states with a mark, or under the pointer. All others look alike."""
        hovered = [self.hovered_state] if self.hovered_state >= 0 else []
        return [*self._nodes, *hovered]

    @property
    def lit_edges(self) -> list[int]:
        """The highlighted edges; they are painted above the others, at every level."""
        lit = list(self._edges)
        if self.hovered_edge >= 0 and self.hovered_edge not in self._edges:
            lit.append(self.hovered_edge)
        return lit

    @property
    def own_lines(self) -> set[int]:
        """The edges that need a line of their own, which no bundle may hide: those with a mark
        that is more than a note."""
        return {edge for edge, look in self._edges.items() if look.stands_out}

    def is_lit(self, edge: int) -> bool:
        """Whether a mark or the pointer is on the edge."""
        return edge in self._edges or edge == self.hovered_edge

    def node(self, state: int) -> NodeLook:
        """The look of the state with this number."""
        found = self._nodes.get(state)
        if found is None:
            aside = self._spot is not None and state not in self._spot
            found = NodeLook(dimmed=self.marks.dimmed or aside)
        return replace(found, hovered=True) if state == self.hovered_state else found

    def edge(self, edge: int) -> EdgeLook:
        """The look of the edge with this number."""
        found = self._edges.get(edge) or (self.dim if edge in self.quiet else self.plain)
        return replace(found, hovered=True) if edge == self.hovered_edge else found

    def change_sign(self, edge: int) -> str:
        """The sign of a comparison on the edge with this number; empty for none."""
        found = self._edges.get(edge)
        return found.change if found is not None else ""

    @property
    def guarded_edges(self) -> list[int]:
        """The edges for which the marks tell the state of their required facts."""
        return list(self._guards)

    def guard(self, edge: int) -> str:
        """The state of an edge's required facts (see ``guard_sign``).

        Empty if the marks do not tell it.
        """
        return self._guards.get(edge, "")

    def change(self, marks: Marks) -> tuple[set[int], set[int]]:
        """Set other marks; returns the numbers of the states and edges whose look changed."""
        nodes, edges, before = self._nodes, self._edges, (self.marks.dimmed, self._spot)
        guards = self._guards
        self.marks = marks
        self._read(marks)
        if before != (marks.dimmed, self._spot):
            return set(range(len(self._picture))), set(range(len(self._picture.operations)))
        states = {
            i for i in nodes.keys() | self._nodes.keys() if nodes.get(i) != self._nodes.get(i)
        }
        changed = {
            e for e in edges.keys() | self._edges.keys() if edges.get(e) != self._edges.get(e)
        }
        both = guards.keys() | self._guards.keys()
        return states, changed | {e for e in both if guards.get(e) != self._guards.get(e)}

    def _read(self, marks: Marks) -> None:
        self._spot = self._neighbours(marks)
        self.plain = EdgeLook(dimmed=marks.dimmed or self._spot is not None)
        """The look of every edge without a highlight."""
        self.dim = EdgeLook(dimmed=True)
        """The look of quiet edges."""
        nodes: dict[int, dict[str, object]] = {}
        edges: dict[int, dict[str, object]] = {}
        named = ((self._picture.edge(address), how) for address, (how, _) in marks.guards.items())
        self._guards = {edge: how for edge, how in named if edge >= 0}
        self._read_run(marks, nodes, edges)
        for address in marks.selection:
            self._note(address, "selected", True, nodes, edges)
        if len(marks.selection) == 1 and not marks.dimmed:
            self._light_out(marks.selection[0], edges)
        if self._spot is not None:
            self._light_all(self._picture.node(marks.selection[0]), edges)
        for address in marks.ways:
            self._note(address, "trail", True, nodes, edges)
        if marks.hit is not None:
            self._note(marks.hit, "hit", True, nodes, edges)
        for address, letter in marks.findings.items():
            self._note(address, "finding", letter, nodes, edges)
        for address in marks.failing:
            self._note(address, "finding", "E", nodes, edges)
        for address, sign in marks.changes.items():
            self._note(address, "change", sign, nodes, edges)
        for address, number in marks.conflicts.items():
            self._note(address, "conflict", number, nodes, edges)
        if marks.dimmed:
            self._near(nodes, edges)
        self._nodes = {
            i: NodeLook(dimmed=marks.dimmed, **given)  # type: ignore[arg-type]
            for i, given in nodes.items()
        }
        self._edges = {
            e: EdgeLook(dimmed=marks.dimmed, **given)  # type: ignore[arg-type]
            for e, given in edges.items()
        }

    def _neighbours(self, marks: Marks) -> frozenset[int] | None:
        """The one selected state of a collapsed drawing with those that operations join with it.

        None if nothing else is to be dimmed.
        """
        picture = self._picture
        if not picture.collapsed or marks.dimmed or len(marks.selection) != 1:
            return None
        state = picture.node(marks.selection[0])
        if state < 0:
            return None
        starts, edges = picture.incident
        own = edges[starts[state] : starts[state + 1]]
        return frozenset({state, *picture.source[own].tolist(), *picture.target[own].tolist()})

    def _read_run(
        self, marks: Marks, nodes: dict[int, dict[str, object]], edges: dict[int, dict[str, object]]
    ) -> None:
        index = self._picture.index
        for name, key in (
            *((marks.active, "active"),),
            *((s, "visited") for s in marks.visited),
            *((s, "next") for s in marks.next_states),
            *((s, "goal") for s in marks.goals),
        ):
            if name is not None and name in index:
                nodes.setdefault(index[name], {})[key] = True
        sensed: dict[int, dict[int, str]] = {}
        for (name, digit), quality in marks.facts.items():
            if name in index:
                sensed.setdefault(index[name], {})[digit] = quality
        for state, qualities in sensed.items():
            nodes.setdefault(state, {})["facts"] = tuple(sorted(qualities.items()))
        for addresses, key in (
            (marks.trail, "trail"),
            (marks.planned, "planned"),
            (marks.pruned, "pruned"),
            (marks.held_back, "held_back"),
            (marks.risky, "risky"),
            (marks.possible, "possible"),
        ):
            for address in addresses:
                self._note(address, key, True, {}, edges)
        if marks.running is not None:
            address, share = marks.running
            self._note(address, "running", -1.0 if share is None else share, {}, edges)

    def _light_out(self, address: Address, edges: dict[int, dict[str, object]]) -> None:
        """Highlight the operations that leave the one selected state."""
        state = self._picture.node(address)
        if state < 0:
            return
        first = int(self._picture.first[state])
        for edge in range(first, first + len(self._picture.branch.table[address.state])):
            edges.setdefault(edge, {})["out"] = True

    def _light_all(self, state: int, edges: dict[int, dict[str, object]]) -> None:
        """Highlight all operations of the one selected state of a collapsed drawing. The lane that
        leads back to it stays a lane.
        """
        picture = self._picture
        starts, own = picture.incident
        for edge in own[starts[state] : starts[state + 1]].tolist():
            if picture.source[edge] == state or edge not in picture.all_bundles.back:
                edges.setdefault(edge, {})["joined"] = True

    def _near(
        self, nodes: dict[int, dict[str, object]], edges: dict[int, dict[str, object]]
    ) -> None:
        """Mark the two states of each planned, pruned or running operation, so that they are not
        dimmed."""
        for edge, given in edges.items():
            if given.keys() & {"planned", "pruned", "running", "risky", "held_back"}:
                for end in (self._picture.source[edge], self._picture.target[edge]):
                    nodes.setdefault(int(end), {})["near"] = True

    def _note(
        self,
        address: Address,
        key: str,
        value: object,
        nodes: dict[int, dict[str, object]],
        edges: dict[int, dict[str, object]],
    ) -> None:
        edge = self._picture.edge(address)
        if edge >= 0:
            edges.setdefault(edge, {})[key] = value
            return
        state = self._picture.node(address)
        if state >= 0:
            nodes.setdefault(state, {})[key] = value
