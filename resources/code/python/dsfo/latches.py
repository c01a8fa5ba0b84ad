"""The effects of stop, take over and the ways back. Nothing that was going on resumes by itself."""

from __future__ import annotations

from collections.abc import Mapping

from .carrier import RUNNING
from .driver import Driver
from .elements import FactKey, fact_text
from .errors import WorldGone
from .needed import everywhere


def stop(driver: Driver, *, by: str) -> str:
    """Brake and latch. If nobody attends the run, or its world is gone, the run ends."""
    run, gone = driver.run, ""
    try:
        touched = _cut(driver, f"stopped by {by}")
    except WorldGone as error:  # a world that is gone does not move
        touched, gone = _end_all(driver), f" {error.sentence[:1].upper()}{error.sentence[1:]}."
    driver.state.latch(stopped=by)
    driver.state.touched = touched
    driver.say(f"Stopped by {by}.{gone}")
    run.tell("stopped", by=by)
    if gone or not driver.attended:
        driver.finish("stopped", driver.sentence)
    return ""


def reset(driver: Driver, *, by: str) -> str:
    """Release the stop to paused. What the stopped operation may have changed is unknown."""
    run, state = driver.run, driver.state
    touched, state.touched, state.stopped = state.touched, [], ""
    state.pause(carrying=False)
    driver.say("")
    run.tell("reset", by=by, unknown=list(map(fact_text, touched)))
    why = "an operation that was stopped may have changed it"
    run.hear(run.senses.doubt(touched, why))
    return ""


def end(driver: Driver, *, by: str) -> str:
    """End a run that is stopped or holds."""
    held = driver.state.held
    if held is None:
        driver.finish("stopped", driver.sentence)
    else:
        driver.finish(held.ends, held.reason)
    return ""


def take_over(driver: Driver, *, by: str) -> str:
    """Lock automation out. The dispatcher only observes."""
    run = driver.run
    _cut(driver, f"{by} took over")
    driver.state.latch(taken_over=by)
    driver.say(f"{by[:1].upper()}{by[1:]} has taken over.")
    run.tell("taken_over", by=by)
    # The person may change anything, so earlier answers about the scene do not count any more.
    run.hear(run.senses.forget(run.blueprint.sensed()))
    return ""


def give_back(driver: Driver, *, by: str) -> str:
    """Find the configuration from the scene. If exactly one fits, it is offered."""
    driver.run.look()
    driver.state.offered = None
    facts = everywhere(driver.run)
    if not facts:
        return _offer(driver)
    return driver.desk.ask(
        facts, lambda _: driver.say(_offer(driver) or driver.sentence), keep=True
    )


def _offer(driver: Driver) -> str:
    """Offer the configuration that fits the scene. Return why there is none."""
    run, found = driver.run, driver.trouble.located()
    if len(found) == 1:
        driver.state.offered = found[0]
        return ""
    if found:
        names = " or ".join(map(_states, found))
        return f"the scene agrees with several configurations, {names}; make it one of them"
    checks = [check for check in run.checks(run.configuration) if check.truth is not True]
    words = [word for c in checks for word in run.words([*c.misses, *c.unknown])]
    facts = f": {'; '.join(words)}" if words else ""
    return f"the scene agrees with no configuration of the blueprint{facts}"


def accept(driver: Driver, *, by: str) -> str:
    """Accept the offered configuration, if the scene still fits it. The run is then paused."""
    run, state, offered = driver.run, driver.state, driver.state.offered
    if offered is None:
        return "nothing is offered: give it back first"
    run.look()
    if driver.trouble.located() != [offered]:
        state.offered = None
        return f"the scene no longer agrees with {_states(offered)} alone: give it back again"
    state.latch()
    state.paused = not state.by_hand
    driver.say("")
    driver.loops.forget()
    run.tell("given_back", by=by, configuration=dict(offered))
    driver.trouble.adopt(offered)
    driver.endangered()
    return ""


def adopt(driver: Driver, *, by: str) -> str:
    """Adopt the only configuration that fits the scene, for a run that holds."""
    found = driver.trouble.candidates
    if len(found) != 1:
        several = " or ".join(map(_states, found))
        return f"the scene agrees with {several or 'no configuration'}, not with exactly one"
    driver.run.look()
    if not driver.run.stands(found[0]):
        return f"the scene no longer agrees with {_states(found[0])}: resume reads it again"
    driver.release()
    driver.loops.forget()
    driver.trouble.adopt(found[0])
    driver.endangered()
    return ""


def leave(driver: Driver) -> None:
    """Note that nobody attends the run any more. If it waits for somebody, it ends."""
    if driver.phase == "waiting":
        driver.desk.settled()
    driver.attended = False
    held, phase = driver.state.held, driver.phase
    if held is not None and phase in ("no_route", "fault_hold"):
        driver.finish(held.ends, held.reason)
    elif phase == "stopped":
        driver.finish("stopped", driver.sentence)
    elif phase in ("ready", "paused") and _at_goals(driver):
        driver.state.by_hand = False
        driver.state.resume()
        driver.arrival.closing = True
    elif phase == "waiting" and not driver.told:
        driver.finish("refused", f"The start is not known, and {driver.desk.nobody}.")
    elif phase == "waiting":
        _finish(driver, f"The run is waiting, and {driver.desk.nobody}.")
    elif phase in ("ready", "paused", "taken_over"):
        words = phase.replace("_", " ").replace("ready", "waiting to be asked")
        _finish(driver, f"The run is {words}, and nobody is there to go on with it.")


def _finish(driver: Driver, sentence: str) -> None:
    if driver.carrier is not None:
        driver.carrier.cut("nobody is there to go on with it")
        driver.run.drop_pending()
    driver.finish("held", sentence)


def _at_goals(driver: Driver) -> bool:
    here = driver.run.configuration
    idle = driver.carrier is None and not driver.desk.busy
    return idle and all(here[branch] == state for branch, state in driver.course.goals)


def _cut(driver: Driver, reason: str) -> list[FactKey]:
    """Brake the world and end what is carried out. Return the facts that it may have changed."""
    carrier = driver.carrier
    if carrier is None or carrier.stage != RUNNING:
        driver.run.host.cancel()
    touched = [] if carrier is None else carrier.cut(reason)
    _end_all(driver)
    return touched


def _end_all(driver: Driver) -> list[FactKey]:
    """End everything that was going on or planned. Return the facts that it may have changed."""
    carrier, driver.carrier = driver.carrier, None
    driver.desk.withdraw()
    driver.reviewer.forget()
    driver.run.drop_pending()
    driver.course.drop_plan()
    driver.release()
    return carrier.touched if carrier is not None else []


def _states(configuration: Mapping[str, str]) -> str:
    return ", ".join(f"{name}/{state}" for name, state in configuration.items())
