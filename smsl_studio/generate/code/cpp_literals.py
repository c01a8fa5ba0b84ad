"""Values as C++17 text."""

from __future__ import annotations

LONGEST = 88
"""The largest number of characters between the quotes of one piece of a text."""
_KEYWORDS = (
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t "
    "char8_t class co_await co_return co_yield compl concept const const_cast consteval constexpr "
    "constinit continue decltype default delete do double dynamic_cast else enum explicit export "
    "extern false float for friend goto if inline int long mutable namespace new noexcept not "
    "not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires "
    "return short signed sizeof static static_assert static_cast struct switch template this "
    "thread_local throw true try typedef typeid typename union unsigned using virtual void "
    "volatile wchar_t while xor xor_eq"
)
_MACROS = "assert errno stdin stdout stderr offsetof setjmp linux unix i386 major minor makedev"
_USED = "std dsfo world edge fact own states edges failures operations sensors main"
TAKEN = frozenset(f"{_KEYWORDS} {_MACROS} {_USED}".split())
"""Words that cannot be the name of a generated function."""


def text(value: str) -> str:
    """Return a text as a literal of plain ASCII. A long one is cut into pieces, which C++ joins.

    >>> print(text('a "b"'), text("é?"))
    "a \\"b\\"" "\\303\\251\\?"
    """
    return " ".join(pieces(value))


def pieces(value: str) -> list[str]:
    """Return the literals of the pieces of a text, at least one."""
    found, piece = [], ""
    for byte in value.encode("utf-8"):
        piece += _escaped(byte)
        if len(piece) >= LONGEST:
            found.append(f'"{piece}"')
            piece = ""
    return [*found, f'"{piece}"'] if piece or not found else found


def _escaped(byte: int) -> str:
    if chr(byte) in '"\\?':
        return f"\\{chr(byte)}"
    return chr(byte) if 0x20 <= byte < 0x7F else f"\\{byte:03o}"


def number(value: float) -> str:
    """Return a number as a literal of type double."""
    return repr(float(value))
