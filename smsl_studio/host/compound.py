"""Codecs that are made of other codecs: optional values, rows, mappings, records."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

from smsl_studio.host.codec import COUNT, Codec, Unfit, a_byte, at_most, type_of, whole

T = TypeVar("T")
K = TypeVar("K")
V = TypeVar("V")


def optional(inner: Codec[T]) -> Codec[T | None]:
    """The codec of a value or None."""

    def write(value: T | None, out: bytearray) -> None:
        """Write one byte (is there a value?), then the value."""
        out.append(value is not None)
        if value is not None:
            inner.write(value, out)

    def read(data: bytes, at: int) -> tuple[T | None, int]:
        """Read the byte, then the value if there is one."""
        return inner.read(data, at + 1) if a_byte(data, at) else (None, at + 1)

    return Codec(write, read)


def several(inner: Codec[T], most: int) -> Codec[tuple[T, ...]]:
    """The codec of a tuple of at most ``most`` values."""
    write_one, read_one = inner.write, inner.read

    def write(values: Sequence[T], out: bytearray) -> None:
        """Write the number of values (uint32), then each value."""
        if not isinstance(values, (tuple, list)):
            raise Unfit(f"is {type_of(values)}, not a row of values")
        out += COUNT.pack(at_most(len(values), most))
        for index, value in enumerate(values):
            try:
                write_one(value, out)
            except Unfit as error:
                raise error.at(f"[{index}]") from None

    def read(data: bytes, at: int) -> tuple[tuple[T, ...], int]:
        """Read the count and the values. Unfit if there are too many."""
        count = at_most(COUNT.unpack_from(data, at)[0], most)
        at += 4
        found: list[T] = []
        try:
            for _ in range(count):
                value, at = read_one(data, at)
                found.append(value)
        except Unfit as error:
            raise error.at(f"[{len(found)}]") from None
        return tuple(found), at

    return Codec(write, read)


def repeated(inner: Codec[K], most: int) -> Codec[tuple[K, ...]]:
    """As ``several``, for rows in which many values are equal: each different value is written
    once."""
    table, indices = several(inner, most), several(whole(0, most), most)

    def write(values: Sequence[K], out: bytearray) -> None:
        """Write each different value once, then the index of every value."""
        different = {value: at for at, value in enumerate(dict.fromkeys(values))}
        table.write(tuple(different), out)
        indices.write(tuple([different[value] for value in values]), out)

    def read(data: bytes, at: int) -> tuple[tuple[K, ...], int]:
        """Read both tables. Unfit if an index has no value."""
        different, at = table.read(data, at)
        told, at = indices.read(data, at)
        if any(index >= len(different) for index in told):
            raise Unfit("names a value that is not told")
        return tuple([different[index] for index in told]), at

    return Codec(write, read)


def mapping(
    key: Codec[K], value: Codec[V], most: int, *, few: bool = False
) -> Codec[Mapping[K, V]]:
    """The codec of a dict of at most ``most`` entries, in their order and without equal keys.

    ``few`` says that there are few different values (see ``repeated``).
    """
    keys = several(key, most)
    values = repeated(value, most) if few else several(value, most)

    def write(pairs: Mapping[K, V], out: bytearray) -> None:
        """Write all keys, then all values."""
        if not isinstance(pairs, Mapping):
            raise Unfit(f"is {type_of(pairs)}, not a mapping")
        keys.write(tuple(pairs), out)
        values.write(tuple(pairs.values()), out)

    def read(data: bytes, at: int) -> tuple[Mapping[K, V], int]:
        """Read keys and values. Unfit if a key comes twice, or if their numbers differ."""
        names, at = keys.read(data, at)
        told, at = values.read(data, at)
        found = dict(zip(names, told, strict=False))
        if not len(found) == len(names) == len(told):
            raise Unfit("tells a key twice, or not one value for each key")
        return found, at

    return Codec(write, read)


def row(*inner: Codec[Any]) -> Codec[tuple[Any, ...]]:
    """The codec of a tuple with one value for each inner codec."""
    writes = tuple(one.write for one in inner)
    reads = tuple(one.read for one in inner)

    def write(values: Sequence[Any], out: bytearray) -> None:
        """Write the values in order."""
        if not isinstance(values, tuple) or len(values) != len(writes):
            raise Unfit(f"is {type_of(values)}, not {len(writes)} values")
        for write_one, value in zip(writes, values, strict=True):
            write_one(value, out)

    def read(data: bytes, at: int) -> tuple[tuple[Any, ...], int]:
        """Read one value with each inner codec."""
        found = []
        for read_one in reads:
            value, at = read_one(data, at)
            found.append(value)
        return tuple(found), at

    return Codec(write, read)


def record(cls: type[T], left_out: Sequence[str] = (), **inner: Codec[Any]) -> Codec[T]:
    """The codec of a dataclass or named tuple, with an inner codec for each field.

    The fields in ``left_out`` are not sent and keep their default. TypeError if the fields are not
    the fields of the class: so a new field cannot be forgotten in the declaration of a message.
    """
    own = tuple(f.name for f in fields(cls)) if is_dataclass(cls) else cls._fields  # type: ignore[attr-defined]
    if set(own) != set(inner) | set(left_out):
        raise TypeError(f"the fields of {cls.__name__} are {', '.join(own)}")
    names = tuple(one for one in own if one in inner)
    writes = tuple(inner[one].write for one in names)
    reads = tuple((one, inner[one].read) for one in names)

    def write(value: T, out: bytearray) -> None:
        """Write the fields in the order of the class. Unfit for an object of another class."""
        if type(value) is not cls:
            raise Unfit(f"is {type_of(value)}, not {cls.__name__}")
        for one, write_one in zip(names, writes, strict=True):
            try:
                write_one(getattr(value, one), out)
            except Unfit as error:
                raise error.at(f".{one}") from None

    def read(data: bytes, at: int) -> tuple[T, int]:
        """Read the fields and create the object."""
        found = {}
        for one, read_one in reads:
            try:
                found[one], at = read_one(data, at)
            except Unfit as error:
                raise error.at(f".{one}") from None
        return cls(**found), at

    return Codec(write, read)


def mapped(inner: Codec[V], to_told: Callable[[T], V], from_told: Callable[[V], T]) -> Codec[T]:
    """The codec of a value that is sent in another shape.

    ``to_told`` makes this shape of the value. ``from_told`` makes the value of the shape, or
    raises Unfit.
    """

    def write(value: T, out: bytearray) -> None:
        """Write the value in the shape of ``to_told``."""
        inner.write(to_told(value), out)

    def read(data: bytes, at: int) -> tuple[T, int]:
        """Read the shape, and return the value that ``from_told`` makes of it."""
        told, at = inner.read(data, at)
        return from_told(told), at

    return Codec(write, read)
