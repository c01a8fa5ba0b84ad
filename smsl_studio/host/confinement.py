"""Confinement: the kernel refuses some system calls to a process that runs library code.

A plugin runs with its user's rights, and this is no sandbox. Confinement keeps a plugin from
signalling or reading the program that started it. It also keeps a plugin in its process group, so
that the plugin's own children end with it. A refused call fails with EPERM or EACCES
(PermissionError in Python). The confinement includes every process that the plugin starts, and
cannot be removed. On Linux there are two means. On other systems, and on processors that are not
listed below, there is none:

- A seccomp filter refuses calls by their numbers and arguments: signals to the named processes, a
  new process group, a new session.
- A Landlock domain (Linux 5.19 and later) refuses to trace any process outside of it, and so also
  access by ``/proc/PID`` to open files and memory, even for root. From Linux 6.12 on it also
  refuses every signal to a process outside. It refuses nothing else.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import signal
import struct
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

MOST_PIDS = 100
"""The largest number of protected processes and threads. A jump in a filter has at most 255
steps."""

_LOAD, _EQUAL, _AT_LEAST, _RETURN = 0x20, 0x15, 0x35, 0x06
_ALLOW, _REFUSE = 0x7FFF0000, 0x00050000 | errno.EPERM
_NUMBER, _PROCESSOR, _ARGUMENTS = 0, 4, 16

_SIGNAL_OF_END, _NO_NEW_PRIVILEGES, _SET_FILTER, _KEEP_SPEED = 1, 38, 1, 4
_SET_OWNER, _SET_OWNER_EX, _PUSH_INPUT, _CONSOLE = 8, 15, 0x5412, 0x541C

_OTHER_ABI = 0x40000000
"""The first call number of the x32 ABI on x86_64. Its calls have other numbers than ``CALLS``."""

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_ASK_VERSION, _BENEATH, _MOVES, _SIGNALS = 1, 1, 1 << 13, 1 << 1
_FENCES, _FENCES_SIGNALS = 2, 6
"""The first versions of Landlock that can restrict moves between folders, and signals."""

CALLS = {
    "x86_64": {
        "audit": 0xC000003E, "seccomp": 317, "kill": 62, "tkill": 200, "tgkill": 234,
        "rt_sigqueueinfo": 129, "rt_tgsigqueueinfo": 297, "pidfd_open": 434, "ptrace": 101,
        "process_vm_writev": 311, "prlimit64": 302, "setpgid": 109, "setsid": 112, "fcntl": 72,
        "ioctl": 16,
    },
    "aarch64": {
        "audit": 0xC00000B7, "seccomp": 277, "kill": 129, "tkill": 130, "tgkill": 131,
        "rt_sigqueueinfo": 138, "rt_tgsigqueueinfo": 240, "pidfd_open": 434, "ptrace": 117,
        "process_vm_writev": 271, "prlimit64": 261, "setpgid": 154, "setsid": 157, "fcntl": 25,
        "ioctl": 29,
    },
}  # fmt: skip

_ON_PIDS = {
    "kill": 0, "tkill": 0, "tgkill": 0, "rt_sigqueueinfo": 0, "rt_tgsigqueueinfo": 0,
    "pidfd_open": 0, "ptrace": 1, "process_vm_writev": 0, "prlimit64": 0,
}  # fmt: skip
"""Calls that act on a process, with the position of the argument that names this process."""


def confine(*processes: int) -> bool:
    """Confine this process for ever: it cannot signal ``processes``, read the files and memory of
    others, or leave its group.

    Return False if the system cannot do that. Call it while the process has only one thread.
    """
    calls = CALLS.get(platform.machine())
    if sys.platform != "linux" or calls is None or sys.maxsize < 2**32:
        return False
    protected = [one for process in processes for one in _known_as(process)]
    program = b"".join(_program(calls, protected[:MOST_PIDS]))
    libc = ctypes.CDLL(None, use_errno=True)
    if not no_new_privileges(libc):
        return False
    _fence_in(libc)
    return set_filter(libc, program)


def no_new_privileges(libc: ctypes.CDLL) -> bool:
    """Give up new privileges for ever, as a filter asks. Return False if that cannot be done."""
    return not libc.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0)


def set_filter(libc: ctypes.CDLL, program: bytes) -> bool:
    """Let the kernel ask a seccomp filter before each call, for ever. Return whether it will."""
    steps = ctypes.create_string_buffer(program, len(program))
    head = struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(steps))
    number = CALLS[platform.machine()]["seccomp"]
    return bool(libc.syscall(number, _SET_FILTER, _KEEP_SPEED, head) == 0)


def end_with(parent: int) -> None:
    """Let the kernel kill this process when its parent process, with the number ``parent``,
    ends."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SIGNAL_OF_END, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        os._exit(1)


def keeps_apart() -> bool:
    """Whether confined processes cannot signal each other. Only then may several run together."""
    known = sys.platform == "linux" and platform.machine() in CALLS
    return known and landlock_version(ctypes.CDLL(None)) >= _FENCES_SIGNALS


def landlock_version(libc: ctypes.CDLL) -> int:
    """Return the version of Landlock in this kernel. It is less than 1 if there is none."""
    return int(libc.syscall(_CREATE_RULESET, None, 0, _ASK_VERSION))


def _fence_in(libc: ctypes.CDLL) -> None:
    """Enter a Landlock domain if the kernel has Landlock.

    A domain must handle at least one right. This domain handles moves between folders, and allows
    them everywhere.
    """
    version = landlock_version(libc)
    if version < _FENCES:
        return
    more = struct.pack("QQ", 0, _SIGNALS) if version >= _FENCES_SIGNALS else b""
    restrict_to(libc, _MOVES, {"/": _MOVES}, more)


def restrict_to(
    libc: ctypes.CDLL, handled: int, allowed: Mapping[str, int], more: bytes = b""
) -> None:
    """Enter a Landlock domain. Of the ``handled`` rights to files it keeps what is ``allowed``
    below some folders. ``more`` are the further fields of the domain. Without Landlock nothing
    happens."""
    asked = struct.pack("Q", handled) + more
    ruleset = libc.syscall(_CREATE_RULESET, asked, ctypes.c_size_t(len(asked)), 0)
    if ruleset < 0:
        return
    try:
        for place, rights in allowed.items():
            folder = os.open(place, os.O_PATH | os.O_CLOEXEC)
            try:
                rule = struct.pack("=Qi", rights, folder)
                if libc.syscall(_ADD_RULE, ruleset, _BENEATH, rule, 0) != 0:
                    return
            finally:
                os.close(folder)
        libc.syscall(_RESTRICT_SELF, ruleset, 0)
    finally:
        os.close(ruleset)


def _known_as(process: int) -> Iterator[int]:
    """Yield the numbers by which a process can be signalled: its own, its group's, its threads'."""
    yield process
    with suppress(OSError):
        group = os.getpgid(process)
        yield from [-group] if group else []
    with suppress(OSError):
        for task in Path(f"/proc/{process}/task").iterdir():
            if int(task.name) != process:
                yield int(task.name)


def _program(calls: dict[str, int], protected: Iterable[int]) -> Iterator[bytes]:
    """Yield the steps of the filter. Each call has one block, which ends the filter or leads to
    the next block."""
    yield step(_LOAD, _PROCESSOR)
    yield step(_EQUAL, calls["audit"], 1, 0)
    yield step(_RETURN, _REFUSE)
    yield step(_LOAD, _NUMBER)
    yield step(_AT_LEAST, _OTHER_ABI, 0, 1)
    yield step(_RETURN, _REFUSE)
    refused = [*protected, -1]
    for name, argument in _ON_PIDS.items():
        yield from _block(calls[name], argument, refused)
    yield from _block(calls["fcntl"], 1, [_SET_OWNER, _SET_OWNER_EX])
    yield from _block(calls["ioctl"], 1, [_PUSH_INPUT, _CONSOLE])
    for name in ("setpgid", "setsid"):
        yield step(_LOAD, _NUMBER)
        yield step(_EQUAL, calls[name], 0, 1)
        yield step(_RETURN, _REFUSE)
    yield step(_RETURN, _ALLOW)


def _block(call: int, argument: int, refused: list[int]) -> Iterator[bytes]:
    """Yield the steps that refuse a call with one of the ``refused`` values in its argument. A jump
    is the number of steps to pass over."""
    yield step(_LOAD, _NUMBER)
    yield step(_EQUAL, call, 0, len(refused) + 3)
    yield step(_LOAD, _ARGUMENTS + 8 * argument)
    for index, value in enumerate(refused):
        yield step(_EQUAL, value & 0xFFFFFFFF, len(refused) - index, 0)
    yield step(_RETURN, _ALLOW)
    yield step(_RETURN, _REFUSE)


def step(code: int, value: int, hit: int = 0, miss: int = 0) -> bytes:
    """Return one step of a filter. ``hit`` and ``miss`` are the steps to pass over after it."""
    return struct.pack("HBBI", code, hit, miss, value)
