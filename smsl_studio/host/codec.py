"""A closed binary format for the messages from a child process to its parent.

A ``Codec`` writes one kind of value and reads it back. The declaration of a message builds its
codec once, from the functions below and those of ``compound``. The declaration limits the values,
their number, their length and their size. The bytes contain no types and no nesting of their own:
at each place the reader expects exactly the declared kind of value. So a hostile sender cannot
make the parent create other values, or more values, than declared. The time to read is in
proportion to the number of bytes. Floats are exact. Texts are UTF-8 without surrogates. NaN is
refused. Numbers are little-endian: counts and indices uint32, whole numbers int64, floats IEEE 754
double.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")
K = TypeVar("K")

COUNT = struct.Struct("<I")
"""The format of counts, lengths and indices."""

_WHOLE, _FLOAT = struct.Struct("<q"), struct.Struct("<d")


class Unfit(Exception):  # noqa: N818
    """A value or bytes do not fit the declaration. The text says where and why."""

    def at(self, where: str) -> Unfit:
        """Return the same error with its place one level further out. ``where`` is a field such as
        ``.name``, or an index such as ``[3]``."""
        return Unfit(f"{where}{'' if str(self)[:1] in '[.' else ' '}{self}")


@dataclass(frozen=True, slots=True)
class Codec(Generic[T]):
    """The writer and the reader of one kind of value.

    ``write`` appends a value to a buffer. ``read`` reads the value at an offset, and returns it
    with the offset behind it. Both raise Unfit; ``read`` raises struct.error if the bytes end too
    early.
    """

    write: Callable[[T, bytearray], None]
    read: Callable[[bytes, int], tuple[T, int]]

    def encode(self, value: T) -> bytes:
        """Return the bytes of a whole message. A value that does not fit raises Unfit."""
        out = bytearray()
        self.write(value, out)
        return bytes(out)

    def decode(self, data: bytes) -> T:
        """Return the value of a whole message. Bytes that ``encode`` cannot write raise Unfit."""
        try:
            value, at = self.read(data, 0)
        except struct.error:
            raise Unfit("the message ends too early") from None
        if at != len(data):
            raise Unfit(f"{len(data) - at} bytes stand behind the message")
        return value


def nothing() -> Codec[None]:
    """The codec of None, which takes no bytes."""

    def write(value: None, out: bytearray) -> None:
        """Write no bytes; Unfit for any value but None."""
        if value is not None:
            raise Unfit(f"is {type_of(value)}, not nothing")

    return Codec(write, lambda data, at: (None, at))


def flag() -> Codec[bool]:
    """The codec of True and False."""

    def write(value: bool, out: bytearray) -> None:
        """Write one byte, 0 or 1."""
        if type(value) is not bool:
            raise Unfit(f"is {type_of(value)}, not true or false")
        out.append(value)

    def read(data: bytes, at: int) -> tuple[bool, int]:
        """Read one byte. Unfit if it is not 0 or 1."""
        return a_byte(data, at) == 1, at + 1

    return Codec(write, read)


def whole(least: int, most: int) -> Codec[int]:
    """The codec of whole numbers from ``least`` to ``most``, within 64 bits."""

    def check(value: int) -> int:
        """Return the value. Unfit if it is out of range."""
        if not least <= value <= most:
            raise Unfit(f"is not from {least} to {most}")
        return value

    def write(value: int, out: bytearray) -> None:
        """Write the number as an int64."""
        if type(value) is not int:
            raise Unfit(f"is {type_of(value)}, not a whole number")
        out += _WHOLE.pack(check(value))

    def read(data: bytes, at: int) -> tuple[int, int]:
        """Read an int64. Unfit if it is out of range."""
        return check(_WHOLE.unpack_from(data, at)[0]), at + 8

    return Codec(write, read)


def number(least: float, most: float) -> Codec[float]:
    """The codec of floats from ``least`` to ``most``, without NaN."""

    def check(value: float) -> float:
        """Return the value. Unfit if it is out of range or NaN."""
        if not least <= value <= most:
            raise Unfit(f"is {value!r}, not a number from {least:g} to {most:g}")
        return value

    def write(value: float, out: bytearray) -> None:
        """Write the number as a double."""
        if not isinstance(value, (int, float)) or type(value) is bool:
            raise Unfit(f"is {type_of(value)}, not a number")
        out += _FLOAT.pack(check(value))

    def read(data: bytes, at: int) -> tuple[float, int]:
        """Read a double. Unfit if it is out of range."""
        return check(_FLOAT.unpack_from(data, at)[0]), at + 8

    return Codec(write, read)


def numbers(least: float, most: float, count: int, multiple: int = 1) -> Codec[tuple[float, ...]]:
    """The codec of at most ``count`` floats from ``least`` to ``most``. Their number is a multiple
    of ``multiple``."""

    def check(size: int) -> int:
        """Return the number of floats. Unfit if this number is not allowed."""
        if size > count or size % multiple:
            raise Unfit(f"has {size} numbers, not at most {count}, a multiple of {multiple}")
        return size

    def write(values: Sequence[float], out: bytearray) -> None:
        """Write the count (uint32), then each number as a double."""
        if not isinstance(values, (tuple, list)):
            raise Unfit(f"is {type_of(values)}, not numbers")
        out += COUNT.pack(check(len(values)))
        try:
            out += struct.pack(f"<{len(values)}d", *_within(values, least, most))
        except (struct.error, TypeError):
            raise Unfit("has what is no number") from None

    def read(data: bytes, at: int) -> tuple[tuple[float, ...], int]:
        """Read the count, then the numbers. Unfit if there are too many, or one is out of range."""
        size = check(COUNT.unpack_from(data, at)[0])
        found = struct.unpack_from(f"<{size}d", data, at + 4)
        return _within(found, least, most), at + 4 + 8 * size

    return Codec(write, read)


def exactly(least: float, most: float, count: int) -> Codec[tuple[float, ...]]:
    """The codec of exactly ``count`` floats from ``least`` to ``most``."""
    form = struct.Struct(f"<{count}d")

    def write(values: tuple[float, ...], out: bytearray) -> None:
        """Write the numbers as doubles, without their count."""
        try:
            out += form.pack(*_within(values, least, most))
        except (struct.error, TypeError):
            raise Unfit(f"is not {count} numbers") from None

    def read(data: bytes, at: int) -> tuple[tuple[float, ...], int]:
        """Read the numbers. Unfit if one is out of range."""
        return _within(form.unpack_from(data, at), least, most), at + form.size

    return Codec(write, read)


def text(most: int) -> Codec[str]:
    """The codec of texts of at most ``most`` characters that UTF-8 can encode."""

    def write(value: str, out: bytearray) -> None:
        """Write the number of bytes in UTF-8 (uint32), then the bytes."""
        if not isinstance(value, str):
            raise Unfit(f"is {type_of(value)}, not a text")
        if (length := str.__len__(value)) > most:
            raise Unfit(f"has {length} characters, more than {most}")
        try:
            written = str.encode(value, "utf-8")
        except UnicodeEncodeError:
            raise Unfit("is a text that cannot be written") from None
        out += COUNT.pack(len(written))
        out += written

    def read(data: bytes, at: int) -> tuple[str, int]:
        """Read the text. Unfit if it is too long or no UTF-8."""
        (size,) = COUNT.unpack_from(data, at)
        if size == 0:
            return "", at + 4
        end = at + 4 + size
        if size > 4 * most or end > len(data):
            raise Unfit(f"is a text of {size} bytes, which is too long")
        try:
            found = data[at + 4 : end].decode("utf-8")
        except UnicodeDecodeError:
            raise Unfit("is no text in UTF-8") from None
        if len(found) > most:
            raise Unfit(f"has {len(found)} characters, more than {most}")
        return found, end

    return Codec(write, read)


def opaque(most: int) -> Codec[bytes]:
    """The codec of at most ``most`` bytes without a meaning of their own."""

    def write(value: bytes, out: bytearray) -> None:
        """Write the number of bytes (uint32), then the bytes."""
        out += COUNT.pack(at_most(len(value), most))
        out += value

    def read(data: bytes, at: int) -> tuple[bytes, int]:
        """Read the bytes. Unfit if there are too many."""
        end = at + 4 + at_most(COUNT.unpack_from(data, at)[0], most)
        if end > len(data):
            raise Unfit("ends too early")
        return data[at + 4 : end], end

    return Codec(write, read)


def one_of(options: Sequence[K]) -> Codec[K]:
    """The codec of one of several values that both sides know. Only the index is sent."""
    known: tuple[K, ...] = tuple(options)
    index: dict[Hashable, int] = {value: at for at, value in enumerate(known)}

    def write(value: K, out: bytearray) -> None:
        """Write the index of the value (uint32)."""
        try:
            out += COUNT.pack(index[value])
        except (KeyError, TypeError):
            raise Unfit(f"is {type_of(value)}, which is none of {len(known)}") from None

    def read(data: bytes, at: int) -> tuple[K, int]:
        """Read the index. Unfit if there is no such value."""
        (found,) = COUNT.unpack_from(data, at)
        if found >= len(known):
            raise Unfit(f"is number {found} of {len(known)}")
        return known[found], at + 4

    return Codec(write, read)


def _within(values: Sequence[float], least: float, most: float) -> tuple[float, ...]:
    # If the sum is finite, there is no NaN among the values. min and max are wrong with a NaN.
    total = sum(values)
    if values and not (math.isfinite(total) and least <= min(values) <= max(values) <= most):
        raise Unfit(f"has what is not a number from {least:g} to {most:g}")
    return tuple(values)


def a_byte(data: bytes, at: int) -> int:
    """Return the byte at ``at``. Unfit if it is not 0 or 1, or if there is no byte."""
    if at >= len(data):
        raise Unfit("ends too early")
    if data[at] > 1:
        raise Unfit(f"is {data[at]}, not 0 or 1")
    return data[at]


def at_most(count: int, most: int) -> int:
    """Return the count. Unfit if it is more than ``most``."""
    if count > most:
        raise Unfit(f"has {count} entries, more than {most}")
    return count


def type_of(value: object) -> str:
    """Describe the type of a value in short words. No code of the value runs."""
    return f"a value of type {type(value).__name__[:60]!r}"
