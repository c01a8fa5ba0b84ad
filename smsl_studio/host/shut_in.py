"""Shuts a process in until it ends: the kernel refuses it new processes, connections, and files.

Generated code runs behind this. It is more than the confinement of plugins, which may do all this:
here the world stands already, and a motion needs none of it. Only the folders of Python and of this
program can still be read, because libraries load parts of themselves late, and only ``/dev/null``
can be written. Without Landlock (Linux 6.2 and later) the kernel refuses no file, and Python's
audit alone refuses them to generated code (``library.generated_watch``).
"""

from __future__ import annotations

import ctypes
import platform
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from smsl_studio.host.confinement import (
    CALLS,
    landlock_version,
    no_new_privileges,
    restrict_to,
    set_filter,
    step,
)
from smsl_studio.shipped import plugins_dir

_LOAD, _EQUAL, _ANY_BIT, _RETURN = 0x20, 0x15, 0x45, 0x06
_ALLOW, _REFUSE, _ABSENT = 0x7FFF0000, 0x00050001, 0x00050026
"""Allow a call, refuse it (EPERM), or say that the kernel does not have it (ENOSYS)."""
_NUMBER, _ARGUMENTS = 0, 16
_THREAD = 0x10000
"""The flag of ``clone`` for a thread. A thread stays in this process, and is shut in as it is."""

_REFUSED = {
    "x86_64": (57, 58, 59, 322, 41, 42, 49, 53, 425, 85, 437, 76, 82, 83, 84, 86, 87, 88, 90, 258,
               263, 264, 265, 266, 268, 316),
    "aarch64": (221, 281, 198, 199, 200, 203, 425, 437, 34, 35, 36, 37, 38, 45, 53, 276),
}  # fmt: skip
"""Calls that are refused: fork and vfork, execve and execveat, socket, connect, bind, socketpair,
io_uring, creat, openat2, and what moves, removes, links or changes files."""
_CLONE = {"x86_64": (56, 435), "aarch64": (220, 435)}
"""The calls ``clone`` and ``clone3``."""
_READS = 1 << 2 | 1 << 3
"""Landlock's rights to read a file and to list a folder."""
_WRITES = 1 << 1 | 1 << 2 | 1 << 14
"""Landlock's rights to write, read and empty a file."""
_EVERY_RIGHT = (1 << 15) - 1
"""All rights to files that version 3 of Landlock knows."""
_KNOWS_FILES = 3
NOTHING = "/dev/null"
"""Worlds send here what their engines print."""


def shut_in() -> bool:
    """Shut this process in. Return False if the system cannot do that. A second call does nothing.

    Call it when the world of the process stands.
    """
    global _DONE  # noqa: PLW0603 -- it belongs to the process, as the kernel's filter does
    if _DONE:
        return True
    machine = platform.machine()
    if sys.platform != "linux" or machine not in CALLS or sys.maxsize < 2**32:
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    if not no_new_privileges(libc):
        return False
    if landlock_version(libc) >= _KNOWS_FILES:
        kept = dict.fromkeys(_readable(), _READS)
        restrict_to(libc, _EVERY_RIGHT, {**kept, NOTHING: _WRITES})
    _DONE = set_filter(libc, b"".join(_program(machine)))
    return _DONE


_DONE = False


def _readable() -> Iterable[str]:
    """Return the folders of Python, of its libraries and of this program."""
    libraries = [one for one in sys.path if Path(one).name in ("site-packages", "dist-packages")]
    own = Path(__file__).parent.parent
    python = (sys.prefix, sys.base_prefix, sys.exec_prefix)
    places: tuple[str | Path, ...] = (*python, *libraries, own, plugins_dir())
    found = set()
    for place in places:
        with suppress(OSError):
            whole = Path(place).resolve(strict=True)
            if whole.is_dir() and whole != Path(whole.root):
                found.add(str(whole))
    return sorted(found)


def _program(machine: str) -> Iterator[bytes]:
    """Yield the steps of the filter. Each block ends the filter or leads to the next block."""
    for number in _REFUSED[machine]:
        yield from _when(number, _REFUSE)
    clone, clone3 = _CLONE[machine]
    yield from _when(clone3, _ABSENT)  # its flags stand in memory; libraries then ask for clone
    yield step(_LOAD, _NUMBER)
    yield step(_EQUAL, clone, 0, 4)
    yield step(_LOAD, _ARGUMENTS)
    yield step(_ANY_BIT, _THREAD, 1, 0)
    yield step(_RETURN, _REFUSE)
    yield step(_RETURN, _ALLOW)
    yield step(_RETURN, _ALLOW)


def _when(number: int, answer: int) -> Iterator[bytes]:
    yield step(_LOAD, _NUMBER)
    yield step(_EQUAL, number, 0, 1)
    yield step(_RETURN, answer)
