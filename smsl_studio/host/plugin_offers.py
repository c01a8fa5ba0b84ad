"""The offers of plugins without their code: a child loads the plugins and sends descriptions back.

To load a plugin means to run its code, which may end or hang its process. The window, the command
``plugins`` and a run with a child process need only the names of the offers, so they call
``describe``. A plugin that crashes or hangs gives one named fault; the other plugins are described
all the same.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from smsl_studio.errors import HostError
from smsl_studio.host.codec import Unfit
from smsl_studio.host.confinement import keeps_apart
from smsl_studio.host.description import read_description
from smsl_studio.host.exit_words import ending_words
from smsl_studio.host.patience import Patience
from smsl_studio.host.plugin_child import STEP
from smsl_studio.host.processor import ProcessorTime
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.host.wire import NoAnswer
from smsl_studio.library.loaded import Loaded, Plugin, PluginFault
from smsl_studio.library.loading import gathered
from smsl_studio.library.survey import FoundPlugin, PluginState, survey
from smsl_studio.stop import heed

LIMIT = 20.0
"""The time (s) that one plugin may take to load. Of this and the next limit, time in which the
machine gives the processes next to no processor time does not count (see ``Patience``)."""

GRACE = 10.0
"""The time (s) that the child itself may take to start, and to end a plugin at its limit."""

LOOK = 0.05
"""The wall time (s) between two checks of the limit and the stop."""

_CHILD = "smsl_studio.host.plugin_child"


def describe(
    plugin_paths: Sequence[Path] = (), limit: float = LIMIT, together: int | None = None
) -> Loaded:
    """Return the result of ``discover``, with ``AbsentCode`` in the place of all code.

    ``limit`` is the time (s) for one plugin, without time that the machine does not give it (see
    ``Patience``). ``together`` is the number of plugins that load at the same time (None: one per
    processor, if the system keeps them apart). A call takes about as long as a start of Python, and
    at most 1.5 times ``limit`` if the machine is free. If ``together`` is 0, plugins load one after
    the other, and each plugin that hangs takes its whole ``limit``. The result and the order of all
    faults do not depend on ``together``. HostError if no child can be started. A stop (see
    ``stop``) ends the child.
    """
    every = survey(plugin_paths)
    if together is None:
        together = len(os.sched_getaffinity(0)) if keeps_apart() else 0
    asked = [found for found in every if found.state is PluginState.ALLOWED]
    told: dict[str, Plugin | PluginFault] = {}
    while left := [found for found in asked if found.location not in told]:
        told |= _asked(left, limit, together)
    return gathered(every, lambda found: told[found.location])


def _asked(
    found: Sequence[FoundPlugin], limit: float, together: int
) -> dict[str, Plugin | PluginFault]:
    """Ask a child about plugins. Return at least one answer, by the plugins' locations.

    If the child is lost, the plugin that was loading has a fault. If several plugins were loading,
    each of them is asked again alone.
    """
    try:
        child = start_child(_CHILD)
    except OSError as error:
        raise HostError(f"no process can be started: {error.strerror or error}") from None
    told: dict[str, Plugin | PluginFault] = {}
    begun: dict[str, FoundPlugin] = {}
    loading: dict[int, int] = {}
    try:
        child.wire.send("describe", (list(found), limit, together))
        while (step := _next(child, limit, loading.values())) is not None:
            number, pid, body, words = step
            if number >= len(found):
                raise NoAnswer("it tells of a plugin that was not asked for")
            at = found[number]
            loading.pop(number, None)
            if body is not None:
                told[at.location] = _read(body, at)
            elif words:
                told[at.location] = _fault(at, words)
            else:
                begun[at.location], loading[number] = at, pid
        return told
    except TimeoutError:
        words = f"it did not load within {limit:g} s"
    except (EOFError, OSError):
        words = f"the process that loads plugins {ending_words(child.ending())}"
    except (NoAnswer, Unfit) as error:
        words = f"the process that loads plugins said what is no answer: {error}"
    finally:
        child.release()
    suspects = [one for location, one in begun.items() if location not in told]
    if not suspects and not told:
        raise HostError(f"the plugins cannot be looked at: {words}")
    if len(suspects) == 1:
        return told | {one.location: _fault(one, words) for one in suspects}
    for one in suspects:
        told |= _asked([one], limit, 0)
    return told


def _next(child: Child, limit: float, loading: Collection[int]) -> tuple[Any, ...] | None:
    """Wait for the next message of the child and return it. None at the end.

    ``loading`` has the numbers of the processes in which the child loads plugins.
    """
    wait, pids = Patience(limit + GRACE), (child.pid, *loading)
    given = [ProcessorTime.of(pid) for pid in pids]
    while (frame := child.heard(LOOK)) is None:
        heed()
        before, given = given, [ProcessorTime.of(pid) for pid in pids]
        pairs = zip(given, before, strict=True)
        wait.look(shut_out=any(now.shut_out_since(then) for now, then in pairs))
        if wait.over:
            raise TimeoutError
    return STEP.decode(frame.body) if frame.kind == "loads" else None


def _read(body: bytes, found: FoundPlugin) -> Plugin | PluginFault:
    try:
        return read_description(body, found)
    except Unfit as error:
        return _fault(found, f"its description is not valid: {error}")


def _fault(found: FoundPlugin, words: str) -> PluginFault:
    return PluginFault(found.name, words, None, found.location)
