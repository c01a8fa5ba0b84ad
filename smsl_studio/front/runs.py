"""Runs a blueprint: connects the dispatcher, a host and a log."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import SHOW
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import Foresight
from smsl_studio.dispatch.drive.supervisor import Closing
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.errors import RunRefused, SaveError, StudioError, WorldError
from smsl_studio.front.acceptance import left_out, to_accept
from smsl_studio.front.agents.agents import Agents
from smsl_studio.front.elsewhere import with_remote
from smsl_studio.front.headless import StopAsked, to_its_end
from smsl_studio.front.hosts import known_world, make_host, with_robot
from smsl_studio.front.inputs import refuse_nonsense
from smsl_studio.front.log_seals import seal_of_logs
from smsl_studio.front.proposed_edges import keep_answers, proposer_of
from smsl_studio.front.recorder import Recorder, start_log
from smsl_studio.front.request import (
    RunRequest,
    Several,
    Supervising,
    several,
    supervised_by,
)
from smsl_studio.front.script.addresses import Written, operations_at, states_at
from smsl_studio.front.script.fit import check_faults
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.front.script.script import Act, Script
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.table_faults import table_faults
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.stop import Stopped, heeding, whole
from smsl_studio.world.engines import REMOTE, TABLE

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare


@dataclass(frozen=True)
class Run:
    """A finished run: why it ended, in one word and one sentence, and all its events.

    ``left`` has the acts of its script whose time never came. ``unbound`` has sentences, with
    places, about bindings that do not fit. ``trust`` says who approved the blueprint; it is None if
    neither a policy nor a record was given.

    >>> run(read("hfsm.json"), goal="SB1/State111").reason
    'goal_reached'
    """

    reason: str
    sentence: str
    events: tuple[Event, ...]
    left: tuple[Act, ...] = ()
    unbound: tuple[str, ...] = ()
    trust: str = ""


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
    supervisor: Supervising = None,
    plugin_paths: Sequence[Path] = (),
    loaded: Loaded | None = None,
    broker: str = "",
    site: str = "",
    login: str = "",
    spare: Spare | None = None,
    robot: str = "",
    forecast: str = "",
    generate: str = "",
) -> Dispatcher:
    """Return a dispatcher that is ready to ``open``. The caller ticks it and closes it.

    There may be several starts and goals, at most one for each SB. ``levels`` replace levels that
    the blueprint declares (see ``blueprint.levels``). ``RunRequest`` explains the other arguments.
    ``spare`` (see ``make_ready``) may have a waiting child, so that the run begins at once.
    AddressError for an unknown address, UsageError for arguments that do not fit together,
    RunRefused if the blueprint cannot run (see ``refusals``).

    >>> dispatcher = open_run(read("hanoi-2.json"), goal="State_cc", host="local")
    >>> events = list(dispatcher.open())
    >>> while not dispatcher.finished:
    ...     events += dispatcher.tick()
    >>> events[-1].reason
    'goal_reached'
    >>> dispatcher.close()
    """
    named, agents = supervised_by(supervisor)
    request = RunRequest(
        blueprint,
        world,
        starts=several(start),
        goals=several(goal),
        seed=seed,
        host=host,
        avoid=tuple(avoid),
        levels=levels or {},
        broker=broker,
        site=site,
        login=login,
        on_mismatch=on_mismatch,
        by_hand=not automatic,
        attended=attended,
        supervisor=named,
        agents=agents,
        plugin_paths=tuple(plugin_paths),
        robot=robot,
        forecast=forecast,
        generate=generate,
    )
    return open_request(request, loaded, spare)


def open_request(
    request: RunRequest, loaded: Loaded | None = None, spare: Spare | None = None
) -> Dispatcher:
    """Return a dispatcher for a ``RunRequest`` (see ``open_run``).

    ``loaded`` are plugins that were found already.

    >>> open_request(RunRequest(read("hanoi-2.json"), host="local")).close()
    """
    if request.robot:
        if loaded is None:
            loaded = known_world(request.world, request.plugin_paths, request.host)
        request = with_robot(request, loaded)
    checked = trusted_request(request.checked())
    trust = checked.trust
    if trust is not None:
        trust.must_hold()
    blueprint, chosen = checked.blueprint, Levels(checked.blueprint, checked.levels)
    refuse_nonsense(blueprint, "Mend what this finding says, then run it again.")
    refuse_too_large(Hierarchy(blueprint))
    terms = RunTerms(
        start={at.branch: at.state for at in states_at(blueprint, checked.starts, "start")},
        goals=states_at(blueprint, checked.goals, "goal"),
        seed=checked.seed,
        robot=checked.robot,
        avoid=operations_at(blueprint, checked.avoid),
        on_mismatch=checked.on_mismatch,
        automatic=not checked.by_hand,
        attended=checked.attended,
        findings=to_accept(blueprint, chosen),
        left_out=left_out(blueprint),
        approved=trust is not None,
        hardware=trust is not None and (trust.hardware or checked.may_be_hardware),
        met=trust.met if trust is not None else (),
        foresight=_foresight(checked, loaded, chosen),
        proposer=proposer_of(checked, loaded),
    )
    supervisor = checked.supervisor
    if checked.agents and isinstance(supervisor, Agents):
        supervisor.open()
        if supervisor.forecasts and not checked.forecast:
            shown = replace(checked, forecast=SHOW)
            terms = replace(terms, foresight=_foresight(shown, loaded, chosen))
    try:
        host = with_remote(checked, make_host(checked, loaded, spare))
    except BaseException:
        if isinstance(supervisor, Closing):
            supervisor.close()
        raise
    return Dispatcher(blueprint, host, terms, levels=chosen, supervisor=supervisor)


def _foresight(request: RunRequest, loaded: Loaded | None, levels: Levels) -> Foresight | None:
    if not (request.forecast or levels.forecasts):
        return None
    from smsl_studio.front.twin_process import foresight_of

    return foresight_of(request, loaded)


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
    supervisor: Supervising = None,
    log: Path | str | None = None,
    on_event: Callable[[Event], None] | None = None,
    stop_when: Callable[[], bool] | None = None,
    plugin_paths: Sequence[Path] = (),
    broker: str = "",
    site: str = "",
    login: str = "",
    policy: Path | str | None = None,
    record: Path | str | None = None,
    passphrase: bytes = b"",
    robot: str = "",
    forecast: str = "",
    generate: str = "",
    address: str = "",
    token_file: str = "",
) -> Run:
    """Run a blueprint without a window to its end, and return what happened.

    ``speed`` is simulated time divided by wall time (1.0: real time); None means as fast as
    possible. ``script`` (see ``read_script``) supervises the run. While the script has further
    lines, it attends the run; after that a hold ends the run, as in every run without a person.
    Lines of the script may replace ``levels``. ``log`` is written line by line during the run.
    ``on_event`` is called with each event after that. ``stop_when`` is called before every tick,
    and True stops the run. ``broker`` (HOST:PORT), ``site`` and ``login`` are for remote sensors;
    with such sensors ``speed`` is at most 1. ``policy`` is a trust policy, and ``record`` a record:
    with either the run is refused unless the blueprint is approved. ``passphrase`` opens the
    recorder's key of this computer, which signs the head of the log; without it
    ``SMSL_PASSPHRASE`` counts, and without both the log is not signed. ``address`` and
    ``token_file`` are for the world remote. ``RunRequest`` explains the other arguments.

    SealError if the passphrase is wrong. AddressError, UsageError, PluginError and WorldError for
    names that do not exist. ReadError if the script injects a fault that the world does not have.
    Every other failure is the ``reason`` of the run.

    >>> done = run(read("hanoi-corrected.json"), goal="State_ccc", seed=0)
    >>> done.reason, done.events[-1].operations
    ('goal_reached', 7)
    """
    named, agents = supervised_by(supervisor)
    request = RunRequest(
        blueprint,
        world,
        starts=several(start),
        goals=several(goal),
        seed=seed,
        host=host,
        avoid=tuple(avoid),
        levels=levels or {},
        script=script,
        broker=broker,
        site=site,
        login=login,
        on_mismatch=on_mismatch,
        speed=speed,
        log=None if log is None else Path(log),
        attended=True if script and script.acts else None,
        supervisor=named,
        agents=agents,
        plugin_paths=tuple(plugin_paths),
        policy=None if policy is None else Path(policy),
        record=None if record is None else Path(record),
        seal=None if log is None else seal_of_logs(passphrase),
        robot=robot,
        forecast=forecast,
        generate=generate,
        address=address,
        token_file=token_file,
    )
    return run_request(request, on_event, stop_when)


def run_request(
    request: RunRequest,
    on_event: Callable[[Event], None] | None = None,
    stop_when: Callable[[], bool] | None = None,
) -> Run:
    """Carry out a ``RunRequest`` without a window, to its end (see ``run``).

    >>> run_request(RunRequest(read("hanoi-2.json"), goals=("State_cc",))).reason
    'goal_reached'
    """
    events: list[Event] = []

    def hear(event: Event) -> None:
        """Keep an event for the result, and hand it to the caller."""
        events.append(event)
        if on_event is not None:
            on_event(event)

    recording, asked = Recorder(hear), StopAsked(stop_when)
    script = request.script
    acting = ScriptPlayer(script) if script and script.acts else None
    dispatcher: Dispatcher | None = None
    loaded: Loaded | None = None
    try:
        with heeding(asked.heed):
            request = trusted_request(request)
            request, loaded = _with_plugins(request)
            request = with_robot(request, loaded)
            checked = request.checked()
            _refuse_unknown_faults(request, loaded)
            refusal: RunRefused | None = None
            try:
                dispatcher = open_request(checked, loaded)
            except RunRefused as refused:
                refusal = refused
            try:
                if request.log is not None:
                    with whole():
                        recording.log = start_log(checked, loaded)
                if refusal is not None:
                    recording.end("refused", refusal.words, None, refusal.told)
                if dispatcher is not None:
                    to_its_end(dispatcher, recording, request.speed, asked, acting)
            except (SaveError, WorldError) as error:
                failed = "failed" if recording.told else "refused"
                recording.end(failed, str(error), dispatcher, told_refusals(request, failed, error))
    except Stopped:
        if request.log is not None:
            # The request may be unchecked here, because the stop may come before the check.
            recording.begin_late(lambda: start_log(request, loaded))
        recording.stop(dispatcher)
    finally:
        try:
            if dispatcher is not None:
                keep_answers(request.log, dispatcher)
                dispatcher.close()
        finally:
            recording.close()
    done = _over(events, acting, dispatcher)
    return replace(done, trust=request.trust.words) if request.trust is not None else done


def _refuse_unknown_faults(request: RunRequest, loaded: Loaded | None) -> None:
    """Raise ReadError if the script injects a fault that the world does not have. What a program
    elsewhere offers is not known before it is opened."""
    script, world, drawn = request.script, request.world, request.blueprint
    if script is None or world == REMOTE or (request.trust and request.trust.refusals):
        return
    check_faults(script, world, loaded.faults_of(world) if loaded else table_faults(drawn))


def trusted_request(request: RunRequest) -> RunRequest:
    """Return the request, with the answer whether it may start if it needs an approval."""
    if request.trust is not None or not request.asks_approval:
        return request
    from smsl_studio.front.trust import with_trust

    return with_trust(request)


def _with_plugins(request: RunRequest) -> tuple[RunRequest, Loaded | None]:
    """Return the request, and the plugins of its world. Signed code that has changed since it was
    verified is not loaded, and the request is refused."""
    world, paths, trust = request.world, request.plugin_paths, request.trust
    if trust is None:
        return request, known_world(world, paths, request.host)
    if trust.refusals or world in (TABLE, REMOTE):
        return request, None
    if request.host != "local":
        return request, trust.loaded
    try:
        return request, known_world(world, paths, request.host, trust.code)
    except WorldError as error:
        changed = replace(trust, refusals=(Refusal("code_changed", str(error)),))
        return replace(request, trust=changed), None


def told_refusals(
    request: RunRequest, reason: str, error: StudioError
) -> Sequence[Mapping[str, str]]:
    """Return an error at the start as refusals, if the run needed an approval."""
    if isinstance(error, RunRefused):
        return error.told
    if request.trust is None or reason != "refused":
        return ()
    code = "log_unwritable" if isinstance(error, SaveError) else "code_changed"
    return ({"code": code, "sentence": str(error)},)


def _over(
    events: Sequence[Event], acting: ScriptPlayer | None, dispatcher: Dispatcher | None
) -> Run:
    last = events[-1]
    assert isinstance(last, RunFinished), "the last event of a run is run_finished"
    left = acting.left if acting else ()
    opened = dispatcher.opened if dispatcher is not None else None
    unbound = opened.faults if opened is not None else ()
    return Run(last.reason, last.sentence, tuple(events), left, unbound)
