"""Running a blueprint: the dispatcher, a host and a log, wired once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.effort import refuse_too_large
from smsl_studio.dispatch.supervisor import Supervisor
from smsl_studio.errors import RunRefused, SaveError, UsageError, WorldError
from smsl_studio.front.acceptance import to_accept
from smsl_studio.front.elsewhere import with_remote
from smsl_studio.front.headless import StopAsked, to_its_end
from smsl_studio.front.hosts import known_world, make_host
from smsl_studio.front.inputs import refusals
from smsl_studio.front.recorder import Recorder, start_log
from smsl_studio.front.run_header import asked_for
from smsl_studio.front.script.addresses import Written, operations_at, states_at
from smsl_studio.front.script.fit import check_faults
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.front.script.script import Act, Script
from smsl_studio.front.supervisors import supervisor_of
from smsl_studio.library.loading import Loaded
from smsl_studio.library.operation_library import TABLE
from smsl_studio.library.table_faults import table_faults
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.stop import Stopped, heeding, whole

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare

HOSTS = ("local", "process")
Several = Written | Iterable[Written] | None


@dataclass(frozen=True)
class Run:
    """A run that is over: why it ended, in one word and one sentence, and everything it said.

    ``left`` are the acts of its script whose moment never came, ``unbound`` says which bindings do
    not fit, and where they are written.
    """

    reason: str
    sentence: str
    events: tuple[Event, ...]
    left: tuple[Act, ...] = ()
    unbound: tuple[str, ...] = ()


def open_run(
    blueprint: Blueprint,
    world: str = TABLE,
    *,
    goal: Several = None,
    start: Several = None,
    seed: int = 0,
    host: str = "process",
    avoid: Iterable[Written] = (),
    on_mismatch: str = "hold",
    automatic: bool = True,
    attended: bool | None = None,
    levels: Mapping[str, str] | None = None,
    supervisor: Supervisor | None = None,
    plugin_paths: Sequence[Path] = (),
    loaded: Loaded | None = None,
    broker: str = "",
    site: str = "",
    spare: Spare | None = None,
) -> Dispatcher:
    """A dispatcher that is ready to ``open``; the caller ticks it and closes it.

    Several starts or goals may be given, one an SB. ``levels`` are set before this run and win
    over what the blueprint declares (see ``blueprint.levels``). AddressError and UsageError for
    what makes no sense, RunRefused where the blueprint cannot run at all (see ``refusals``).
    ``spare`` (see ``make_ready``) has a child in waiting, so that the run begins at once.
    """
    _one_of(host, HOSTS, "host")
    _one_of(on_mismatch, ("hold", "adopt"), "on_mismatch")
    starts = {at.branch: at.state for at in states_at(blueprint, start, "start")}
    goals = states_at(blueprint, goal, "goal")
    shut = operations_at(blueprint, avoid)
    chosen = Levels(blueprint, levels or {})
    _refuse_nonsense(blueprint)
    refuse_too_large(Hierarchy(blueprint))
    made = make_host(
        blueprint, world, seed, host, plugin_paths=plugin_paths, loaded=loaded, spare=spare
    )
    return Dispatcher(
        blueprint,
        with_remote(blueprint, made, world, seed, broker=broker, site=site),
        start=starts,
        goals=goals,
        seed=seed,
        avoid=shut,
        on_mismatch=on_mismatch,
        automatic=automatic,
        attended=attended,
        levels=chosen,
        supervisor=supervisor_of(chosen, supervisor),
        findings=to_accept(blueprint, chosen),
    )


def run(
    blueprint: Blueprint,
    world: str = TABLE,
    goal: Several = None,
    start: Several = None,
    *,
    seed: int = 0,
    host: str = "local",
    speed: float | None = None,
    avoid: Iterable[Written] = (),
    on_mismatch: str = "hold",
    script: Script | None = None,
    levels: Mapping[str, str] | None = None,
    supervisor: Supervisor | None = None,
    log: Path | str | None = None,
    on_event: Callable[[Event], None] | None = None,
    stop_when: Callable[[], bool] | None = None,
    plugin_paths: Sequence[Path] = (),
    broker: str = "",
    site: str = "",
) -> Run:
    """Run a blueprint headless to its end, and tell what happened.

    ``speed`` paces it against wall time (1.0: as fast as real), None runs as fast as it goes.
    ``script`` (see ``read_script``) supervises it; while it has something to say it attends the
    run, and where it has no more a hold is the end, as in every run that nobody attends. What
    ``levels`` sets before the run (see ``open_run``), a script's own lines may set otherwise.
    ``log`` is written line by line as the run goes; ``on_event`` hears each event after that.
    ``stop_when`` is asked before every tick. ``broker`` (HOST:PORT) and ``site`` say where sensors
    are heard that are elsewhere; with such sensors ``speed`` is at most 1. AddressError,
    UsageError, PluginError and WorldError for what does not exist, ReadError where the script
    injects what this world has not; whatever else goes wrong is the reason of the run.
    """
    events: list[Event] = []

    def hear(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)

    recording, asked = Recorder(hear), StopAsked(stop_when)
    acting = ScriptPlayer(script) if script and script.acts else None
    dispatcher: Dispatcher | None = None
    loaded: Loaded | None = None
    try:
        with heeding(asked.heed):
            loaded = known_world(world, plugin_paths, host)
            goals = states_at(blueprint, goal, "goal")
            starts = states_at(blueprint, start, "start")
            shut = operations_at(blueprint, avoid)
            if script is not None:
                check_faults(
                    script, world, loaded.faults_of(world) if loaded else table_faults(blueprint)
                )
            chosen = {**(levels or {}), **(script.levels if script else {})}
            supervisor = supervisor_of(Levels(blueprint, chosen), supervisor)
            refusal: RunRefused | None = None
            try:
                dispatcher = open_run(
                    blueprint,
                    world,
                    goal=goals,
                    start=starts,
                    seed=seed,
                    host=host,
                    avoid=shut,
                    on_mismatch=on_mismatch,
                    attended=True if acting else None,
                    levels=chosen,
                    supervisor=supervisor,
                    plugin_paths=plugin_paths,
                    loaded=loaded,
                    broker=broker,
                    site=site,
                )
            except RunRefused as refused:
                refusal = refused
            try:
                if log is not None:
                    how = asked_for(
                        seed=seed,
                        host=host,
                        start=starts,
                        goals=goals,
                        avoid=shut,
                        on_mismatch=on_mismatch,
                        script=script,
                        levels=chosen,
                        supervisor=supervisor.name if supervisor else "",
                    )
                    with whole():
                        recording.log = start_log(
                            Path(log), blueprint, world, loaded, how, broker, site
                        )
                if refusal is not None:
                    recording.end("refused", f"{refusal.sentence}. {refusal.advice}".strip(), None)
                if dispatcher is not None:
                    to_its_end(dispatcher, recording, speed, asked, acting)
            except (SaveError, WorldError) as error:
                failed = "failed" if recording.told else "refused"
                recording.end(failed, str(error), dispatcher)
    except Stopped:
        if log is not None:
            how = asked_for(
                seed=seed,
                host=host,
                start=_written(start),
                goals=_written(goal),
                avoid=_written(avoid),
                on_mismatch=on_mismatch,
                script=script,
                levels=levels,
            )
            recording.begin_late(
                lambda: start_log(Path(log), blueprint, world, loaded, how, broker, site)
            )
        recording.stop(dispatcher)
    finally:
        try:
            if dispatcher is not None:
                dispatcher.close()
        finally:
            recording.close()
    return _over(events, acting, dispatcher)


def _written(asked: Several | Iterable[Written]) -> tuple[str, ...]:
    """What was asked for, as it was written: nobody has looked yet whether it is there."""
    if asked is None:
        return ()
    return (str(asked),) if isinstance(asked, str | Address) else tuple(map(str, asked))


def _over(
    events: Sequence[Event], acting: ScriptPlayer | None, dispatcher: Dispatcher | None
) -> Run:
    last = events[-1]
    assert isinstance(last, RunFinished), "the last event of a run is run_finished"
    left = acting.left if acting else ()
    opened = dispatcher.opened if dispatcher is not None else None
    unbound = opened.faults if opened is not None else ()
    return Run(last.reason, last.sentence, tuple(events), left, unbound)


def _refuse_nonsense(blueprint: Blueprint) -> None:
    found = refusals(blueprint)
    if found:
        more = f" (and {len(found) - 1} more findings like it)" if len(found) > 1 else ""
        raise RunRefused(
            f"{found[0].rule} {found[0].address}: {found[0].message}{more}",
            found[0].place,
            "Mend what this finding says, then run it again.",
        )


def _one_of(value: str, known: Sequence[str], what: str) -> None:
    if value not in known:
        raise UsageError(f"{what} is {value!r}, not one of {', '.join(known)}")
