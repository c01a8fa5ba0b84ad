"""The processor time that the machine gives to a child process."""

from __future__ import annotations

import time
from pathlib import Path
from typing import NamedTuple


class ProcessorTime(NamedTuple):
    """The processor time of the main thread of a process until the monotonic time ``at`` (s).

    ``ran`` is the time (s) in which the thread worked. ``waited`` is the time (s) in which it was
    ready but no processor was free; the kernel counts a wait when the wait ends. ``ready`` says
    whether the thread is now ready to work, or waits for memory from a disk. All values are 0 if
    the kernel does not report them or the process is gone.
    """

    at: float
    ran: float = 0.0
    waited: float = 0.0
    ready: bool = False

    @classmethod
    def of(cls, pid: int) -> ProcessorTime:
        """Return the processor time of a process until now."""
        now, about = time.monotonic(), Path(f"/proc/{pid}")
        try:
            ran, waited = (
                int(word) / 1e9 for word in (about / "schedstat").read_text().split()[:2]
            )
            # The name of the program stands in brackets and may contain brackets, too.
            ready = (about / "stat").read_bytes().rpartition(b") ")[2][:1] in (b"R", b"D")
        except (OSError, ValueError):
            return cls(now)
        return cls(now, ran, waited, ready)

    def starved_since(self, before: ProcessorTime) -> bool:
        """Whether the process has had too little processor time for a short answer since
        ``before``.

        That is so if it waited most of the time, or if it is ready and has hardly worked. The
        second case covers waits that the kernel does not count: a wait that has not ended yet, a
        wait for a disk, and processor time that a hypervisor took from the whole machine.
        """
        wall = self.at - before.at
        return self.waited - before.waited > wall / 2 or self.shut_out_since(before)

    def shut_out_since(self, before: ProcessorTime) -> bool:
        """Whether the process is ready to work and has had next to no processor time since
        ``before``, so that it cannot even do little."""
        return self.ready and self.ran - before.ran < (self.at - before.at) / 10
