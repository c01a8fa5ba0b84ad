"""The command line: ``run`` carries the blueprint out on the table world.

Exit status 0: every goal was reached; 1: it was not; 2: wrong usage.
"""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence

from .addresses import operations_at, states_at
from .dispatcher import Dispatcher, unbegun
from .driver import RunTerms
from .elements import Blueprint, address
from .errors import RunRefused, UsageError, WorldGone
from .events import Event, event, line
from .log import RunLog, header
from .player import Player
from .record import Trust, trusted
from .script import Script, read_script


def main(blueprint: Blueprint, words: Sequence[str] | None = None) -> int:
    """Carry out the words of the command line. Return the exit status."""
    parser = argparse.ArgumentParser(description="Carries out a blueprint (SMSL).")
    verbs = parser.add_subparsers(dest="verb", required=True)
    run = verbs.add_parser("run", help="carry it out on the table world")
    _several(run, "--goal", "SB/State", "where to go (default: ACTIVATING of the roots)")
    _several(run, "--start", "SB/State", "where to begin (default: INITIAL)")
    _several(run, "--avoid", "ADDRESS", "an operation not to use")
    run.add_argument("--script", metavar="FILE", help="supervise it by a script, JSON Lines")
    run.add_argument("--log", metavar="LOG", help="write the log of the run")
    run.add_argument("--policy", metavar="FILE", help="start only if this trust policy is met")
    run.add_argument("--record", metavar="RECORD", help="start only if this record approves it")
    run.add_argument("--seed", type=int, default=0, help="what chance of disturbances comes from")
    run.add_argument("--on-mismatch", choices=("hold", "adopt"), default="hold")
    run.add_argument("--world", choices=("table",), default="table")
    run.add_argument("--format", choices=("text", "json"), default="text")
    options = parser.parse_args(words)
    try:
        return _Run(blueprint, options).carried_out()
    except UsageError as error:
        print(*filter(None, (error.sentence, error.advice)), sep="\n", file=sys.stderr)
        return 2


def _several(parser: argparse.ArgumentParser, name: str, metavar: str, words: str) -> None:
    parser.add_argument(
        name, action="append", default=[], metavar=metavar, help=f"{words}; may be repeated"
    )


class _Run:
    """One run from the command line."""

    def __init__(self, blueprint: Blueprint, options: argparse.Namespace) -> None:
        self._blueprint, self._options = blueprint, options
        self._start = states_at(blueprint, options.start, "start")
        self._goals = states_at(blueprint, options.goal, "goal")
        self._avoid = operations_at(blueprint, options.avoid)
        script = read_script(options.script, blueprint) if options.script else None
        self._script: Script = script or Script("", ())
        self._player = Player(self._script) if self._script.acts else None
        self._log: RunLog | None = None
        self._stopping = False
        self._out = sys.stdout
        if options.format == "json":
            sys.stdout = sys.stderr  # what operations print is no event

    def carried_out(self) -> int:
        """Carry it out. Return the exit status."""
        options, script = self._options, self._script
        attended = bool(script.acts)
        trust = trusted(self._blueprint, options.policy, options.record, script.levels)
        dispatcher = Dispatcher(
            self._blueprint,
            start=self._start,
            goals=list(self._goals.items()),
            avoid=self._avoid,
            levels=script.levels,
            terms=RunTerms(
                options.seed, options.on_mismatch == "adopt", attended, trust.asked, trust.met
            ),
        )
        if options.log:
            try:
                self._log = RunLog(options.log, self._header(dispatcher, trust))
            except WorldGone as error:
                told = [{"code": "log_unwritable", "sentence": error.sentence}]
                self._tell([unbegun("refused", error.sentence, told if trust.asked else [])])
                return 1
        try:
            last = self._to_its_end(dispatcher, trust)
        except WorldGone as error:
            self._log = None
            held = {"reason": error.sentence, "details": [], "kind": "held"}
            last = {**unbegun("failed", error.sentence), "t": dispatcher.time}
            self._tell([event("held", dispatcher.time, **held), last])
        for act in self._player.left if self._player else ():
            print(f"{script.file}:{act.line}:1: its moment never came: {act}", file=sys.stderr)
        return 0 if last["reason"] == "goal_reached" else 1

    def _header(self, dispatcher: Dispatcher, trust: Trust) -> dict[str, object]:
        options, script = self._options, self._script
        named = {"file": script.file, "digest": script.digest} if script.file else None
        asked = {
            "world": "table",
            "seed": options.seed,
            "host": "local",
            "start": _texts(self._start),
            "goals": _texts(self._goals),
            "avoid": self._avoid,
            "on_mismatch": options.on_mismatch,
            "by_hand": False,
            "attended": bool(script.acts),
            "levels": dict(script.levels),
            "script": named,
            "supervisor": dispatcher.supervisor.name if dispatcher.supervisor else "",
            "policy": trust.header,
        }
        return header(self._blueprint.identity, asked)

    def _to_its_end(self, dispatcher: Dispatcher, trust: Trust) -> Event:
        try:
            trust.must_hold()
        except RunRefused as refused:
            last = unbegun("refused", refused.words, refused.refusals)
            self._tell([last])
            return last
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask_to_stop)
        self._tell(dispatcher.open())
        while dispatcher.last is None:
            if self._stopping:
                self._stopping, self._player = False, None
                dispatcher.stop()
                dispatcher.leave()
            elif self._player is not None:
                self._player.before(dispatcher)
            self._tell(dispatcher.tick())
        return dispatcher.last

    def _ask_to_stop(self, number: int, frame: object) -> None:
        self._stopping = True

    def _tell(self, events: Sequence[Event]) -> None:
        for one in events:
            if self._log is not None:
                self._log.write([one])
                if one["event"] == "run_finished":
                    self._log.finish()
            text = line(one) if self._options.format == "json" else _in_words(one)
            print(text, file=self._out, flush=True)
        if self._player is not None:
            self._player.hear(events)


def _texts(states: dict[str, str]) -> list[str]:
    return [address(branch, state) for branch, state in states.items()]


def _in_words(one: Event) -> str:
    """Return an event as one line for people."""
    values = {key: value for key, value in one.items() if key not in ("event", "t") and value}
    said = " ".join(f"{key}={line({'': value})[4:-1]}" for key, value in values.items())
    return f"{one['t']:9.3f} s  {one['event'].replace('_', ' ')}  {said}".rstrip()
