"""Elements of a native text: with offsets, and as lengths, which are valid wherever the elements
are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import accumulate
from typing import Literal, NamedTuple, overload

from smsl_studio.smsl.document import Member

Kind = Literal["branch", "state", "edge", "field", "header", "name", "entry"]


class Element(NamedTuple):
    """One element as offsets into the text, with its key and its value.

    The value of a branch is the whole branch. The value of a state is its brackets. ``elements``
    are the lines and states of a branch.
    """

    kind: Kind
    key: str
    start: int
    end: int
    key_start: int
    key_end: int
    value_start: int
    value_end: int
    elements: Sequence[Element] = ()

    @property
    def member(self) -> Member:
        """The element as key and value."""
        return Member(self.key, self.key_start, self.key_end, self.value_start, self.value_end)

    @property
    def is_member(self) -> bool:
        """Whether it is a state or field of a branch, not a part of its header."""
        return self.kind in ("state", "field")


class ElementShape(NamedTuple):
    """An element as lengths, in characters.

    ``before`` is the distance from the end of the element before it. The other offsets count from
    its own beginning.
    """

    kind: Kind
    key: str
    before: int
    length: int
    key_start: int
    key_end: int
    value_start: int
    value_end: int
    inner: ElementShapes | None = None
    """The lines and states of a branch."""

    def at(self, start: int) -> Element:
        """Return the element at the offset ``start``."""
        kind, key, _, length, key_start, key_end, value_start, value_end, inner = self
        elements = () if inner is None else PlacedShapes(inner, start + 1)
        return Element(
            kind, key, start, start + length, start + key_start, start + key_end,
            start + value_start, start + value_end, elements,
        )  # fmt: skip


class ElementShapes:
    """The elements of a file or branch as lengths.

    It never changes. After an edit the new text gets a new one for the changed branches.
    """

    def __init__(self, shapes: list[ElementShape], lengths: list[int]) -> None:
        self.shapes, self.lengths = shapes, lengths

    @classmethod
    def of(cls, elements: Iterable[Element], at: int) -> ElementShapes:
        """Return the shapes of elements that follow each other after the offset ``at``."""
        shapes, lengths = [], []
        for kind, key, start, end, key_start, key_end, value_start, value_end, inside in elements:
            inner = cls.of(inside, start + 1) if kind == "branch" else None
            shapes.append(
                ElementShape(kind, key, start - at, end - start, key_start - start, key_end - start,
                      value_start - start, value_end - start, inner)
            )  # fmt: skip
            lengths.append(end - at)
            at = end
        return cls(shapes, lengths)

    @cached_property
    def ends(self) -> list[int]:
        """For each element the end of the one before it. The last entry is the end of the last
        element.
        """
        return list(accumulate(self.lengths, initial=0))

    @cached_property
    def members(self) -> list[int]:
        """The indices of the states and fields."""
        return [
            index for index, one in enumerate(self.shapes) if one[0] == "state" or one[0] == "field"
        ]

    @cached_property
    def keys(self) -> list[str]:
        """The keys of the states and fields."""
        shapes = self.shapes
        return [shapes[index][1] for index in self.members]

    def patched(self, changes: Sequence[tuple[int, int, ElementShapes]]) -> ElementShapes:
        """Return the shapes with some elements replaced.

        A change is the first index, the index after the last, and the new shapes. Changes are in
        order.
        """
        shapes, lengths = list(self.shapes), list(self.lengths)
        for begin, end, now in reversed(changes):
            shapes[begin:end], lengths[begin:end] = now.shapes, now.lengths
        return ElementShapes(shapes, lengths)


class PlacedShapes(Sequence[Element]):
    """The elements of a file or branch whose content begins at an offset. They are made when
    needed.
    """

    def __init__(self, shapes: ElementShapes, start: int) -> None:
        self.shapes, self.start = shapes, start

    def __len__(self) -> int:
        return len(self.shapes.shapes)

    @overload
    def __getitem__(self, index: int) -> Element: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Element, ...]: ...

    def __getitem__(self, index: int | slice) -> Element | tuple[Element, ...]:
        if isinstance(index, slice):
            return tuple(self[at] for at in range(*index.indices(len(self))))
        at = range(len(self))[index]
        shape = self.shapes.shapes[at]
        return shape.at(self.start + self.shapes.ends[at] + shape.before)

    def __iter__(self) -> Iterator[Element]:
        at = self.start
        for shape in self.shapes.shapes:
            element = shape.at(at + shape.before)
            yield element
            at = element.end
