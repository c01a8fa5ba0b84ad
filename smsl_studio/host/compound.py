"""Codecs made of others: optional values, rows, mappings, records."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

from smsl_studio.host.codec import COUNT, Codec, Unfit, a_byte, at_most, type_of, whole

T = TypeVar("T")
K = TypeVar("K")
V = TypeVar("V")


def optional(inner: Codec[T]) -> Codec[T | None]:
    """A value, or None."""

    def write(value: T | None, out: bytearray) -> None:
        """Write one byte (is there a value?), then the value."""
        out.append(value is not None)
        if value is not None:
            inner.write(value, out)

    def read(data: bytes, at: int) -> tuple[T | None, int]:
        """Read the byte, then the value where there is one."""
        return inner.read(data, at + 1) if a_byte(data, at) else (None, at + 1)

    return Codec(write, read)


def several(inner: Codec[T], most: int) -> Codec[tuple[T, ...]]:
    """A tuple of at most ``most`` values."""
    write_one, read_one = inner.write, inner.read

    def write(values: Sequence[T], out: bytearray) -> None:
        """Write how many values there are (uint32), then each of them."""
        if not isinstance(values, (tuple, list)):
            raise Unfit(f"is {type_of(values)}, not a row of values")
        out += COUNT.pack(at_most(len(values), most))
        for index, value in enumerate(values):
            try:
                write_one(value, out)
            except Unfit as error:
                raise error.at(f"[{index}]") from None

    def read(data: bytes, at: int) -> tuple[tuple[T, ...], int]:
        """Read the count and the values; Unfit where there are too many."""
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
    """As ``several``, for values of which many are equal: each is written once."""
    table, indices = several(inner, most), several(whole(0, most), most)

    def write(values: Sequence[K], out: bytearray) -> None:
        """Write each different value once, then the index of every value."""
        different = {value: at for at, value in enumerate(dict.fromkeys(values))}
        table.write(tuple(different), out)
        indices.write(tuple([different[value] for value in values]), out)

    def read(data: bytes, at: int) -> tuple[tuple[K, ...], int]:
        """Read both tables; Unfit where an index has no value."""
        different, at = table.read(data, at)
        told, at = indices.read(data, at)
        if any(index >= len(different) for index in told):
            raise Unfit("names a value that is not told")
        return tuple([different[index] for index in told]), at

    return Codec(write, read)


def mapping(
    key: Codec[K], value: Codec[V], most: int, *, few: bool = False
) -> Codec[Mapping[K, V]]:
    """A dict of at most ``most`` entries in their order; no key twice. ``few``: few different
    values, see ``repeated``."""
    keys = several(key, most)
    values = repeated(value, most) if few else several(value, most)

    def write(pairs: Mapping[K, V], out: bytearray) -> None:
        """Write all keys, then all values."""
        if not isinstance(pairs, Mapping):
            raise Unfit(f"is {type_of(pairs)}, not a mapping")
        keys.write(tuple(pairs), out)
        values.write(tuple(pairs.values()), out)

    def read(data: bytes, at: int) -> tuple[Mapping[K, V], int]:
        """Read keys and values; Unfit where a key comes twice or the numbers differ."""
        names, at = keys.read(data, at)
        told, at = values.read(data, at)
        found = dict(zip(names, told, strict=False))
        if not len(found) == len(names) == len(told):
            raise Unfit("tells a key twice, or not one value for each key")
        return found, at

    return Codec(write, read)


def row(*inner: Codec[Any]) -> Codec[tuple[Any, ...]]:
    """A tuple with one value of each kind."""
    writes = tuple(one.write for one in inner)
    reads = tuple(one.read for one in inner)

    def write(values: Sequence[Any], out: bytearray) -> None:
        """Write the values one after the other."""
        if not isinstance(values, tuple) or len(values) != len(writes):
            raise Unfit(f"is {type_of(values)}, not {len(writes)} values")
        for write_one, value in zip(writes, values, strict=True):
            write_one(value, out)

    def read(data: bytes, at: int) -> tuple[tuple[Any, ...], int]:
        """Read one value of each kind."""
        found = []
        for read_one in reads:
            value, at = read_one(data, at)
            found.append(value)
        return tuple(found), at

    return Codec(write, read)


def record(cls: type[T], left_out: Sequence[str] = (), **inner: Codec[Any]) -> Codec[T]:
    """A dataclass or named tuple, with a codec for each field.

    ``left_out`` are fields that keep their default here. TypeError, at once, where the fields are
    not those of the class: a new field needs its line where the message is declared.
    """
    own = tuple(f.name for f in fields(cls)) if is_dataclass(cls) else cls._fields  # type: ignore[attr-defined]
    if set(own) != set(inner) | set(left_out):
        raise TypeError(f"the fields of {cls.__name__} are {', '.join(own)}")
    names = tuple(one for one in own if one in inner)
    writes = tuple(inner[one].write for one in names)
    reads = tuple((one, inner[one].read) for one in names)

    def write(value: T, out: bytearray) -> None:
        """Write the fields in the order of the class; Unfit for an object of any other class."""
        if type(value) is not cls:
            raise Unfit(f"is {type_of(value)}, not {cls.__name__}")
        for one, write_one in zip(names, writes, strict=True):
            try:
                write_one(getattr(value, one), out)
            except Unfit as error:
                raise error.at(f".{one}") from None

    def read(data: bytes, at: int) -> tuple[T, int]:
        """Read the fields and make the object from them."""
        found = {}
        for one, read_one in reads:
            try:
                found[one], at = read_one(data, at)
            except Unfit as error:
                raise error.at(f".{one}") from None
        return cls(**found), at

    return Codec(write, read)


def mapped(inner: Codec[V], to_told: Callable[[T], V], from_told: Callable[[V], T]) -> Codec[T]:
    """A value that is sent in another shape: ``to_told`` makes it, ``from_told`` turns it back, or
    raises Unfit."""

    def write(value: T, out: bytearray) -> None:
        """Write what ``to_told`` makes of the value."""
        inner.write(to_told(value), out)

    def read(data: bytes, at: int) -> tuple[T, int]:
        """Read the value, and give what ``from_told`` makes of it."""
        told, at = inner.read(data, at)
        return from_told(told), at

    return Codec(write, read)
