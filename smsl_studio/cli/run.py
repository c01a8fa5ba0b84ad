"""``run``: runs a blueprint in a world without a window. The exit status is 0 if every goal was
reached."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import (
    ArgumentParser,
    add_format,
    add_places,
    add_robot,
    add_seed_and_host,
    add_several,
    add_supervisor,
    add_world,
    host_of,
)
from smsl_studio.cli.blueprint_argument import STDIN, read_argument, standard_input
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.passphrase import recorder_passphrase
from smsl_studio.cli.signals import Signals
from smsl_studio.cli.story import line_of
from smsl_studio.errors import UsageError
from smsl_studio.legible import one_line
from smsl_studio.runlog.ends import UNBEGUN
from smsl_studio.runlog.events import Event, Held, RunFinished
from smsl_studio.runlog.regulation import Commanded
from smsl_studio.stop import Stopped, look_for_garbage

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.front.runs import Run
    from smsl_studio.front.script.script import Script

UNINSPECTED = "UNINSPECTED: no inspection record stands behind this blueprint; simulation only"
GENERATED = (
    "GENERATED, NOT INSPECTED: this blueprint was computed, and no inspection record stands behind "
    "it; simulation only"
)
FUNCTIONS = (
    "GENERATED FUNCTIONS: {} were generated, and only their sweep stands behind them; simulation "
    "only"
)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``run``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_world(parser, required=True)
    add_places(parser)
    add_several(parser, "--avoid", "ADDRESS", "an operation not to use")
    add_robot(parser)
    add_seed_and_host(parser)
    parser.add_argument(
        "--script",
        metavar="FILE",
        help="supervise it by a script: commands, chosen operations and faults at their moments",
    )
    add_supervisor(parser)
    parser.add_argument(
        "--forecast",
        choices=("show", "ask", "hold"),
        default="",
        help="try each operation in a simulated world first; where the forecast differs: tell it, "
        "ask a person, or hold",
    )
    parser.add_argument(
        "--generate",
        default="",
        metavar="PROVIDER",
        help="where no way leads to the goal, ask for further library operations: reader, "
        "by-hand:DIR, replay:FILE or a base URL; a person allows each, for this run only",
    )
    parser.add_argument("--log", metavar="FILE", help="write the run's log, JSON Lines")
    parser.add_argument(
        "--policy", metavar="FILE", help="start only if this trust policy is met (see: verify)"
    )
    parser.add_argument(
        "--record", metavar="RECORD", help="start only if this record approves it (see: approve)"
    )
    parser.add_argument(
        "--speed", default="max", metavar="X|max", help="times real time; max is as fast as it goes"
    )
    parser.add_argument(
        "--on-mismatch",
        choices=("hold", "adopt"),
        default="hold",
        help="where facts and beliefs differ: hold (default), or adopt the only state that agrees",
    )
    parser.add_argument(
        "--broker", default="", metavar="HOST[:PORT]", help="the MQTT broker of sensors elsewhere"
    )
    parser.add_argument("--site", default="", help="the site whose sensors are heard")
    parser.add_argument(
        "--login",
        default="",
        metavar="FILE",
        help="how to log in at the broker, with TLS: a login file (see: nodes make-site)",
    )
    parser.add_argument(
        "--address",
        default="",
        metavar="ADDRESS",
        help="with --world remote: where the program listens, unix:PATH or 127.0.0.1:PORT",
    )
    parser.add_argument(
        "--token-file", default="", metavar="FILE", help="the token that this program asks for"
    )
    parser.add_argument(
        "--passphrase-file",
        metavar="FILE",
        help="with --log: the passphrase of the recorder's key, which signs the log (else "
        "SMSL_PASSPHRASE, else a prompt)",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Run the blueprint and print its events. 0: every goal was reached; 1: it was not."""
    told = _ToldEvents(out, options)
    try:
        return _execute(options, told)
    except Stopped:
        if told.finished or not options.signals.asked:
            raise
        # It was stopped so early that no run could report the stop.
        finished = RunFinished(
            t=0.0, reason="stopped", sentence=UNBEGUN, operations=0, configuration={}
        )
        told.tell(finished)
        return 1


class _ToldEvents:
    """Prints the events of a run on standard output."""

    def __init__(self, out: Output, options: argparse.Namespace) -> None:
        self.finished = False
        self.mark = UNINSPECTED
        self._out, self._form = out, options.format
        self._signals: Signals = options.signals
        self._begun = options.policy is not None or options.record is not None

    def tell(self, event: Event) -> None:
        """Print one event. The last event ends the run, and so it completes a requested stop."""
        if not self._begun:
            self._begun = True
            note(self.mark)
        self._out.line(event.line() if self._form == "json" else one_line(line_of(event)))
        if isinstance(event, RunFinished):
            self.finished = True
            self._signals.take()


def _execute(options: argparse.Namespace, told: _ToldEvents) -> int:
    from smsl_studio.blueprint.levels import Levels
    from smsl_studio.front.approval_badge import is_generated
    from smsl_studio.front.generated_trials import generated_operations
    from smsl_studio.front.inputs import inspect
    from smsl_studio.front.runs import run
    from smsl_studio.front.views.before_run import RunMeans, lacking
    from smsl_studio.world.engines import REMOTE, TABLE

    speed = _speed(options.speed)
    if options.log == "-":
        raise UsageError(
            "a log is a file; the events go to standard output anyway",
            advice="Name a new file, or leave out --log.",
        )
    if options.passphrase_file is not None and options.log is None:
        raise UsageError("--passphrase-file is for --log alone", advice="Name a log, too.")
    blueprint = read_argument(options.file)
    if is_generated(blueprint):
        told.mark = GENERATED
    elif options.world not in (TABLE, REMOTE) and (found := generated_operations(blueprint)):
        told.mark = FUNCTIONS.format(", ".join(found[:5]))
    script = _script(options.script, options.file, blueprint)
    # A misspelt annotation protects nothing, so these findings are shown before every run.
    for finding in inspect(blueprint, ("R29",)):
        note(f"{finding.place}: {finding.message}")
    if script is None:
        # People who answer come with a script alone.
        means = RunMeans(options.world, options.world != REMOTE, None, options.forecast)
        for lack in lacking(blueprint, Levels(blueprint), means):
            note(one_line(lack))
    words = b"" if options.log is None else recorder_passphrase(options)
    look_for_garbage()
    done = run(
        blueprint,
        options.world,
        options.goal,
        options.start,
        seed=options.seed,
        host=host_of(options),
        speed=speed,
        avoid=options.avoid,
        on_mismatch=options.on_mismatch,
        script=script,
        supervisor=options.supervisor,
        log=options.log,
        on_event=told.tell,
        stop_when=options.signals.is_asked,
        broker=options.broker,
        site=options.site,
        login=options.login,
        policy=options.policy,
        record=options.record,
        passphrase=words,
        robot=options.robot,
        forecast=options.forecast,
        generate=options.generate,
        address=options.address,
        token_file=options.token_file,
    )
    for unbound in done.unbound:
        note(unbound)
    if done.trust and done.reason != "refused":
        note(done.trust)
    if script is not None:
        for event in done.events:
            if isinstance(event, Commanded) and event.refused:
                note(f"{script.file}: {_refused(event)}")
    for act in done.left:
        note(f"{act.place}: its moment never came: {act}")
    if done.reason != "goal_reached":
        _explain(done, options.format == "json")
    return 0 if done.reason == "goal_reached" else 1


def _refused(event: Commanded) -> str:
    what = " ".join(filter(None, (event.command.replace("_", " "), event.address, event.value)))
    return f"refused at {event.t:.3f} s: {what}: {event.refused}"


def _explain(done: Run, also_why: bool) -> None:
    """Print why the goal was not reached, and each obstacle on a line of its own."""
    if also_why:
        note(f"{done.reason}: {done.sentence}")
    holds = [event for event in done.events if isinstance(event, Held)]
    for line in holds[-1].details if holds else ():
        edge, _, reason = line.partition(": ")
        # Most reasons name their edge themselves, so the edge is not printed twice.
        note(f"    {reason if reason.startswith(f'{edge} ') else line}")


def _script(file: str | None, blueprint_file: str, blueprint: Blueprint) -> Script | None:
    """Read the script of a run. ``-`` is standard input. UsageError if the blueprint comes from
    there, too."""
    from smsl_studio.front.script.lines import read_script, script_of

    if file is None:
        return None
    if file != "-":
        return read_script(Path(file), blueprint)
    if blueprint_file == "-":
        raise UsageError(
            "the blueprint and the script cannot both be standard input",
            advice="Name a file for one of them.",
        )
    return script_of(standard_input(), STDIN, blueprint)


def _speed(text: str) -> float | None:
    if text == "max":
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0 < speed < float("inf"):
        raise UsageError(f"the speed is {text!r}", advice="Give a number above 0, or max.")
    return speed
