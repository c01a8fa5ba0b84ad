"""How much processor time the machine gives to a child process."""

from __future__ import annotations

import time
from pathlib import Path
from typing import NamedTuple


class ProcessorTime(NamedTuple):
    """The processor time of the main thread of a process until the monotonic time ``at`` (s).

    ``ran`` are the seconds it worked, ``waited`` those in which it could have and all processors
    had other work; a wait is counted when it ends. ``ready`` says whether it would work now if the
    machine let it: no processor is free, or its memory comes from a disk. All is 0 where the
    kernel does not tell or the process is gone.
    """

    at: float
    ran: float = 0.0
    waited: float = 0.0
    ready: bool = False

    @classmethod
    def of(cls, pid: int) -> ProcessorTime:
        """What a process was given until now."""
        now, about = time.monotonic(), Path(f"/proc/{pid}")
        try:
            ran, waited = (
                int(word) / 1e9 for word in (about / "schedstat").read_text().split()[:2]
            )
            # The name of the program, which stands in brackets, may hold anything.
            ready = (about / "stat").read_bytes().rpartition(b") ")[2][:1] in (b"R", b"D")
        except (OSError, ValueError):
            return cls(now)
        return cls(now, ran, waited, ready)

    def starved_since(self, before: ProcessorTime) -> bool:
        """Whether it was given too little time since then for a short answer.

        It waited most of the time, or could work now and has hardly worked: a wait that has not
        ended yet, one for a disk, and a processor that was taken from the whole machine are
        counted nowhere.
        """
        wall = self.at - before.at
        if self.waited - before.waited > wall / 2:
            return True
        return self.ready and self.ran - before.ran < wall / 10
