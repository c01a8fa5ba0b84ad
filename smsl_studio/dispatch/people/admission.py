"""From a proposed step to its beginning: facts that people say, guards, the supervisor, consent.

In this order, each only where the ones before let it pass, and everything before anything moves.
Where people had to be asked the guards are asked once more, because time has passed. Every
function answers why the step was refused at once; empty where it begins or people are asked.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.continuum import HUMAN, SHARED
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.guards import refusals
from smsl_studio.dispatch.people.board import ANSWERED, Closed, Question
from smsl_studio.dispatch.people.desk import no_words, who_words
from smsl_studio.dispatch.people.needed import of_step
from smsl_studio.dispatch.people.questions import (
    GO_ON,
    PAUSE,
    PRUNE,
    confirm_task,
    supervise_task,
)
from smsl_studio.dispatch.run import LiveRun
from smsl_studio.dispatch.trouble import Hold
from smsl_studio.runlog.events import Commanded, OperationPruned, OperationRefused

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver


def admit(driver: Driver, step: JointStep, chosen: bool = False) -> str:
    """Let a step begin, if everything that is asked first agrees. ``chosen``: a person asked for
    it, so nobody has to supervise that choice, and a refusal holds nothing."""
    driver.proposed, driver.chosen = step.asked.address, chosen
    facts = of_step(driver.run, step)
    if not facts:
        return _guarded(driver, step, chosen)

    def said(closed: tuple[Closed, ...]) -> None:
        no = no_words(closed)
        _refuse(driver, step, chosen, (no,)) if no else _guarded(driver, step, chosen)

    nobody = driver.desk.ask(facts, said)
    return _refuse(driver, step, chosen, (nobody,)) if nobody else ""


def supervised(driver: Driver, step: JointStep, why: str = "") -> str:
    """Ask a person whether a step of the route may begin; why that is no use, if it is none."""

    def decided(closed: tuple[Closed, ...]) -> None:
        if closed[0].yes:
            _confirmed(driver, step, chosen=False)
        else:
            _obey(driver, step, closed[0])

    return driver.desk.ask([supervise_task(driver.run.blueprint, step.asked.address, why)], decided)


def _guarded(driver: Driver, step: JointStep, chosen: bool) -> str:
    run = driver.run
    reasons = _barred(driver, step) or refusals(run, step)
    if reasons:
        return _refuse(driver, step, chosen, reasons)
    if chosen:
        objection = driver.reviewer.objection(run, step)
        if objection:
            return _refuse(driver, step, chosen, (objection,))
        return _confirmed(driver, step, chosen, fresh=True)
    circling = driver.loops.why_not(run.configuration, step.asked)
    if circling:
        driver.course.drop_plan()
        driver.hold(Hold(circling))
        return circling
    if not driver.reviewer.lets_begin(driver, step):
        if not driver.desk.busy:
            driver.course.drop_plan()
        return ""
    if run.levels.supervision != HUMAN:
        return _confirmed(driver, step, chosen, fresh=True)
    nobody = supervised(driver, step)
    return _refuse(driver, step, chosen, (nobody,)) if nobody else ""


def _confirmed(driver: Driver, step: JointStep, chosen: bool, fresh: bool = False) -> str:
    """People confirm what must be confirmed, all of it before anything moves; then it begins.

    ``fresh``: the guards were asked at this very moment."""
    questions = confirmations(driver.run, step) if driver.run.people_act else ()
    if not questions:
        return _begin(driver, step, chosen, fresh)

    def said(closed: tuple[Closed, ...]) -> None:
        no = no_words(closed)
        _refuse(driver, step, chosen, (no,)) if no else _begin(driver, step, chosen)

    nobody = driver.desk.ask(questions, said)
    return _refuse(driver, step, chosen, (nobody,)) if nobody else ""


def confirmations(run: LiveRun, step: JointStep) -> tuple[Question, ...]:
    """Whoever must confirm an edge of a step: its ``confirm`` roles, or one person where the
    operation is shared."""
    found = []
    for edge in step.edges:
        if edge.branch not in run.people_act:
            continue
        note = run.blueprint[edge.branch].operation_note(edge.source, edge.name)
        if note.confirm or run.levels.operation(edge.address) == SHARED:
            found.append(confirm_task(run.blueprint, edge.address))
    return tuple(found)


def _begin(driver: Driver, step: JointStep, chosen: bool, fresh: bool = False) -> str:
    """Begin, if the guards still agree."""
    run, state = driver.run, driver.state
    reasons = () if fresh else _barred(driver, step) or refusals(run, step)
    if reasons:
        return _refuse(driver, step, chosen, reasons)
    if chosen:
        driver.course.drop_plan()
        state.paused |= state.held is not None and not state.by_hand
        driver.loops.forget()
        driver.reviewer.forget()
        driver.bypasses.tell((edge.address for edge in step.edges), again=True)
    else:
        driver.loops.count(run.configuration, step.asked)
    driver.begin(step)
    return ""


def _barred(driver: Driver, step: JointStep) -> tuple[str, ...]:
    """What was shut out since the step was worked out."""
    shut = driver.course.shut
    if not shut:
        return ()
    return tuple(f"{one} is {shut[one.address]}" for one in step.edges if one.address in shut)


def _refuse(driver: Driver, step: JointStep, chosen: bool, reasons: tuple[str, ...]) -> str:
    run = driver.run
    driver.course.drop_plan()
    run.emit(OperationRefused(t=run.time, address=str(step.asked), reasons=reasons))
    if not chosen:
        driver.hold(Hold(f"{step.asked} cannot begin: {reasons[0]}", reasons))
    return "; ".join(reasons)


def _obey(driver: Driver, step: JointStep, closed: Closed) -> None:
    """A person has decided against a step: skip it, shut it out, pause; or has not decided."""
    run, address = driver.run, step.asked.address
    if closed.outcome != ANSWERED or closed.answer is None:
        _refuse(driver, step, False, (no_words([closed]),))
        return
    driver.course.drop_plan()
    decision, by = closed.answer.value, who_words(closed)
    assert decision != GO_ON.value, "that is a yes"
    run.emit(Commanded(t=run.time, command=decision, by=by, address=str(address)))
    if decision == PAUSE.value:
        driver.paused_or_held(f"{by} wants a pause before {address}")
    elif decision == PRUNE.value:
        driver.course.prune(address, "")
        run.emit(OperationPruned(t=run.time, address=str(address), reason=""))
    else:
        driver.course.veto(address, run.configuration)
