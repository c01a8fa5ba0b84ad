"""The child in which automatic supervisors run. It has no world, and sees partial views alone."""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from smsl_studio.errors import PluginError, StudioError, UsageError, did_you_mean
from smsl_studio.front.agents.asked_agent import AskedAgent
from smsl_studio.front.agents.shipped import shipped
from smsl_studio.host.bounds import limit_process, settle_in
from smsl_studio.host.brief import brief, words_for
from smsl_studio.host.codec import flag, number, one_of
from smsl_studio.host.compound import row, several
from smsl_studio.host.confinement import confine
from smsl_studio.host.vocabulary import name, sentence
from smsl_studio.host.wire import ChildWire
from smsl_studio.legible import one_line
from smsl_studio.library.entries import SupervisorEntry
from smsl_studio.library.loading import discover
from smsl_studio.library.supervisor_view import ANSWERS, ASK, SupervisorView

READY = several(row(name(300), number(0.0, 1e9), flag()), 100)
"""The name of each supervisor, its time limit (s), and whether it decides by forecasts."""
ANSWER = row(one_of(ANSWERS), sentence(500))
REFUSAL = sentence(2000)
Agent = Callable[[SupervisorView], Any]


def main(pipe: int, beat: int) -> None:
    """Answer for the supervisors until the parent is gone. ``pipe`` and ``beat`` are file numbers;
    no heartbeat is written.
    """
    settle_in()
    os.close(beat)
    wire = ChildWire(socket.socket(fileno=pipe))
    confine(os.getppid())
    agents: list[Agent] = []
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        while True:
            verb, told = wire.receive()
            if verb == "open":
                try:
                    found = found_agents(*told)
                except StudioError as error:
                    words = f"{error.sentence}. {error.advice or ''}".strip().removesuffix(".")
                    wire.send("refused", REFUSAL.encode(words))
                    continue
                limit_process()
                agents = [agent for _, agent in found]
                ready = tuple((entry.name, entry.limit, entry.forecasts) for entry, _ in found)
                wire.send("ok", READY.encode(ready))
            else:
                number_, view = told
                wire.send("ok", ANSWER.encode(answer_of(agents[number_], view)))
    os._exit(0)


def found_agents(
    asked: Sequence[AskedAgent], plugin_paths: Sequence[str]
) -> list[tuple[SupervisorEntry, Agent]]:
    """Return each supervisor with its options. Plugins are loaded only if one of theirs is asked
    for.

    UsageError for an unknown name, and for options that do not fit.
    """
    known = dict(shipped().supervisors)
    faults: tuple[object, ...] = ()
    if any(one.name not in known for one in asked):
        loaded = discover([Path(path) for path in plugin_paths])
        faults = loaded.faults
        for plugin in loaded.plugins:
            known = {**plugin.library.supervisors, **known}
    return [_agent(one, known, faults) for one in asked]


def _agent(
    one: AskedAgent, known: dict[str, SupervisorEntry], faults: Sequence[object]
) -> tuple[SupervisorEntry, Agent]:
    entry = known.get(one.name)
    if entry is None:
        broken = "".join(f" {fault}." for fault in faults)
        advice = did_you_mean(one.name, known) or f"There are {', '.join(sorted(known))}."
        raise UsageError(
            f"there is no supervisor {one.name!r}.{broken}".removesuffix("."), advice=advice
        )
    signature = entry.signature
    try:
        texts = dict(one.options)
        for key, text in texts.items():
            _must_fit(key, text, signature.types.get(key, str))
        options = signature.checked(signature.converted(texts))
    except PluginError as error:
        raise UsageError(f"{one.name}: {error.sentence}", advice=error.advice) from None
    made = entry.function

    def agent(view: SupervisorView) -> Any:
        """Ask the supervisor with its options."""
        return made(view, **options)

    if entry.prepare is not None:
        _prepare(entry, options)
    return entry, agent


def _prepare(entry: SupervisorEntry, options: Mapping[str, Any]) -> None:
    """Let a supervisor read what its options name. A mistake is told before the run."""
    assert entry.prepare is not None
    try:
        entry.prepare(**options)
    except StudioError as error:
        raise UsageError(f"{entry.name}: {error}", advice=error.advice) from None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what compiled libraries raise
        raise UsageError(f"{entry.name} cannot be prepared: {words_for(error)}") from None


def _shown(answer: object) -> str:
    """Show what a supervisor said. Its own ``__repr__`` may raise any error."""
    if type(answer) is str:
        return repr(answer[:60])
    return f"a value of type {brief(type(answer).__name__, 60)!r}"


def _must_fit(key: str, text: str, kind: object) -> None:
    """Raise PluginError if a text is no value of the type of its parameter."""
    if kind is bool and text not in ("true", "false"):
        raise PluginError(f"{key} is {text[:60]!r}, not true or false")
    try:
        if kind is int:
            int(text)
        elif kind is float:
            float(text)
    except ValueError:
        what = "a whole number" if kind is int else "a number"
        raise PluginError(f"{key} is {text[:60]!r}, not {what}") from None


def answer_of(agent: Agent, view: SupervisorView) -> tuple[str, str]:
    """Ask one supervisor. An error and a word that is no answer mean that a person is asked."""
    try:
        said = agent(view)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what compiled libraries raise
        return ASK, f"it failed, {words_for(error)}"
    answer, reason = said if type(said) is tuple and len(said) == 2 else (said, "")
    if type(answer) is not str or answer not in ANSWERS:
        return ASK, f"{_shown(answer)} is no answer"
    if type(reason) is not str:
        return ASK, f"its reason is of type {type(reason).__name__!r}"
    return answer, one_line(brief(reason, 400))
