"""The effects of stop, take over and the ways back. Nothing that was going on resumes by itself.

The effects import what they need of a run inside the functions, so that the table of commands loads
without it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import fact_text
from smsl_studio.dispatch.supervision.row import PERSON
from smsl_studio.errors import HostError
from smsl_studio.stop import LONGEST, BrokenOff, StopListener, Stopped, heeding

if TYPE_CHECKING:
    from smsl_studio.blueprint.check import FactKey
    from smsl_studio.dispatch.drive.driver import Driver

PATIENCE = 2
"""How often a stop checks whether the world has braked, before it ends the process instead."""
MUTE = "the simulation process did not brake and was ended"


def stop(driver: Driver, *, by: str = PERSON) -> str:
    """Brake and latch. If nobody attends the run, or its world is gone, the run ends."""
    from smsl_studio.runlog.events import RunStopped

    run, state = driver.run, driver.state
    gone = ""
    try:
        with heeding(StopListener(PATIENCE, LONGEST).heed):
            touched = _cut(driver, f"stopped by {by}")
    except BrokenOff:
        raise
    except (HostError, Stopped) as error:  # a world that is gone does not move
        words = error.sentence if isinstance(error, HostError) else MUTE
        touched, gone = _end_all(driver), f" {words[:1].upper()}{words[1:]}."
    state.stop(by, touched)
    driver.say(f"Stopped by {by}.{gone}")
    run.emit(RunStopped(t=run.time, by=by))
    if gone or not driver.attended:
        driver.finish("stopped", driver.sentence)
    return ""


def reset(driver: Driver, *, by: str = PERSON) -> str:
    """Release the stop to paused. The facts that the stopped operation may have changed are
    unknown.
    """
    from smsl_studio.runlog.events import RunReset

    run, touched = driver.run, driver.state.reset()
    driver.say("")
    unknown = tuple(fact_text(*key) for key in touched)
    run.emit(RunReset(t=run.time, by=by, unknown=unknown))
    run.emit(*run.senses.doubt(touched, "an operation that was stopped may have changed it"))
    return ""


def end(driver: Driver, *, by: str = PERSON) -> str:
    """End a run that is stopped or holds."""
    held = driver.state.held
    if held is None:
        driver.finish("stopped", driver.sentence)
    else:
        driver.finish(held.ends, held.reason)
    return ""


def take_over(driver: Driver, *, by: str = PERSON) -> str:
    """Lock automation out. The dispatcher only observes."""
    from smsl_studio.blueprint.levels import sensed_facts
    from smsl_studio.runlog.events import TakenOver

    run = driver.run
    _cut(driver, f"{by} took over")
    driver.state.take_over(by)
    driver.say(f"{by[:1].upper()}{by[1:]} has taken over.")
    run.emit(TakenOver(t=run.time, by=by))
    # The person may change anything, so earlier answers about the scene do not count any more.
    run.emit(*run.senses.forget(sensed_facts(run.blueprint)))
    return ""


def give_back(driver: Driver, *, by: str = PERSON) -> str:
    """Find the configuration from the scene, after people were asked for the facts that only they
    know. If exactly one fits, it is offered to be accepted.
    """
    from smsl_studio.dispatch.execution.needed import everywhere

    driver.run.look()
    driver.state.offer(None)
    facts = everywhere(driver.run)
    if not facts:
        return _offer(driver)

    def said(_: object) -> None:
        """Offer what is possible with the new facts. The answers themselves are not read here."""
        driver.say(_offer(driver) or driver.sentence)

    return driver.desk.ask(facts, said, keep=True)


def _offer(driver: Driver) -> str:
    """Offer the configuration that fits the scene. Return why there is none, or the empty text."""
    from smsl_studio.dispatch.execution.recovery import located
    from smsl_studio.dispatch.execution.words import all_words

    run, state = driver.run, driver.state
    found = located(run)
    if len(found) == 1:
        state.offer(found[0])
        return ""
    if found:
        names = " or ".join(_states(one) for one in found)
        return f"the scene agrees with several configurations, {names}; make it one of them"
    checks = [check for check in run.checks(run.configuration) if check.truth is not True]
    words = [
        word
        for check in checks
        for word in all_words(run.blueprint, (*check.misses, *check.unknown))
    ]
    facts = f": {'; '.join(words)}" if words else ""
    return f"the scene agrees with no configuration of the blueprint{facts}"


def accept(driver: Driver, *, by: str = PERSON) -> str:
    """Accept the offered configuration, if the scene still fits it. The run is then paused, or
    ready by hand.
    """
    from smsl_studio.dispatch.execution.recovery import located
    from smsl_studio.runlog.events import GivenBack

    run, state, offered = driver.run, driver.state, driver.state.offered
    if offered is None:
        return "nothing is offered: give it back first"
    run.look()
    if located(run) != (offered,):
        state.offer(None)
        return f"the scene no longer agrees with {_states(offered)} alone: give it back again"
    run.senses.vouch()
    state.give_back()
    driver.say("")
    driver.loops.forget()
    run.emit(GivenBack(t=run.time, by=by, configuration=dict(offered)))
    driver.trouble.adopt(offered)
    driver.endangered()
    return ""


def adopt(driver: Driver, *, by: str = PERSON) -> str:
    """Adopt the only configuration that fits the scene, for a run that holds."""
    from smsl_studio.dispatch.execution.recovery import stands

    found = driver.trouble.candidates
    if len(found) != 1:
        several = " or ".join(_states(one) for one in found)
        return f"the scene agrees with {several or 'no configuration'}, not with exactly one"
    driver.run.look()
    driver.run.senses.vouch()
    if not stands(driver.run, found[0]):
        return f"the scene no longer agrees with {_states(found[0])}: resume reads it again"
    driver.release()
    driver.loops.forget()
    driver.trouble.adopt(found[0])
    driver.endangered()
    return ""


def _states(configuration: object) -> str:
    assert isinstance(configuration, dict)
    return ", ".join(f"{name}/{state}" for name, state in configuration.items())


def _cut(driver: Driver, reason: str) -> tuple[FactKey, ...]:
    """Brake the world and end what is carried out. Return the facts that it may have changed."""
    from smsl_studio.dispatch.execution.stage import ActionStage

    run, carrier = driver.run, driver.carrier
    touched: tuple[FactKey, ...] = ()
    if carrier is None or carrier.stage is not ActionStage.RUNNING:
        run.host.cancel("hold")
    if carrier is not None:
        touched = carrier.cut(reason)
    _end_all(driver)
    return touched


def _end_all(driver: Driver) -> tuple[FactKey, ...]:
    """End everything that was going on or planned. Return the facts that it may have changed."""
    carrier = driver.let_go()
    driver.desk.withdraw()
    driver.reviewer.forget()
    driver.run.drop_pending()
    driver.course.drop_plan()
    driver.release()
    return carrier.touched if carrier is not None else ()
