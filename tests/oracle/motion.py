"""Before and during motion: clauses 2, 4, 5, 10, and the facts that are watched at every tick (9).

It also checks the effects of commands and of latches (docs/supervision.md).
"""

from __future__ import annotations

from tests.oracle import danger
from tests.oracle.carriage import put_below
from tests.oracle.situation import HAIR, LONGEST, TICK, Json, Situation, Step


def started(now: Situation, event: Json) -> None:
    """An edge is being carried out."""
    edge = event["address"]
    step = now.step
    if step is None:
        step = _begin_step(now, edge)
    elif step.broken or step.failed:
        clause = 9 if step.broken else 8
        now.broken(clause, f"{edge} begins although {step.broken or step.failed}")
    step.started.append(edge)
    _is_expected(now, step, event)
    for _, lost in _needs_of(now, edge):
        now.broken(4, f"{edge} begins without {lost}")


def _begin_step(now: Situation, edge: str) -> Step:
    """The first edge of a joint step: everything must have been asked before it."""
    asked = now.requested == edge
    plans = now.carriages(edge, asked)
    step = now.step = Step(edge, plans, asked, now.now)
    now.requested = ""
    if edge in now.vetoed and not asked:
        now.broken(4, f"{edge} begins by itself where it was vetoed")
    if now.latched:
        now.broken(9, f"{edge} begins although the run is {now.latched}")
    if not plans:
        now.broken(_why_not(now, edge, asked), f"{edge} is not available from here, but it begins")
        return step
    step.began_in = dict(now.configuration)
    _guards(now, step)
    danger.begins(now, step)
    _reviewed(now, step)
    return step


def _why_not(now: Situation, edge: str, asked: bool) -> int:
    """The clause by which an edge is not available."""
    drawing = now.drawing
    name = edge.split("/", 1)[0]
    shut = edge in now.shut or (edge in now.terms.bypassed and not asked)
    if shut or now.configuration[name] != drawing.edges[edge][0]:
        return 4
    if drawing.is_crossing(edge):
        return 10
    return 5 if drawing.kind(edge) != "pure" else 4


def _guards(now: Situation, step: Step) -> None:
    """Clause 4: for every edge of the joint step, before anything moves."""
    assert step.plan is not None
    met: set[str] = set()
    for edge in step.plan.starts:
        name = edge.split("/", 1)[0]
        source = now.drawing.edges[edge][0]
        if edge in now.shut:
            now.broken(4, f"{edge} is {now.shut[edge]}, but {step.edge} begins")
        if name not in met and now.configuration[name] == source:
            result = now.scene.check(name, source, now.configuration)
            if result is not True:
                words = {False: "false", None: "unknown"}[result]
                now.broken(4, f"{name}/{source} checks {words}, but {step.edge} begins")
        met.add(name)
    for lost in now.required_lost(list(step.plan.starts)):
        now.broken(4, f"{lost}, which is not true, but {step.edge} begins")
    for fact in now.critical_lost():
        now.broken(9, f"the critical fact {fact} is not known to be true, but {step.edge} begins")


def _reviewed(now: Situation, step: Step) -> None:
    """Clause 4, the supervisor: an agent's word, or a person's at the level human."""
    word = now.reviews.pop(step.edge, "")
    if word in ("veto", "prune"):
        now.broken(4, f"{step.edge} begins although the supervisor said {word}")
    by_route = not step.asked
    if by_route and word == "ask" and ("supervise", step.edge, "go_on") not in now.agreed:
        now.broken(4, f"{step.edge} begins although the supervisor's question is not answered")
    if (
        by_route
        and now.drawing.supervision == "human"
        and ("supervise", step.edge, "go_on") not in now.agreed
    ):
        now.broken(4, f"{step.edge} begins, but nobody has let it begin")


def _needs_of(now: Situation, edge: str) -> list[tuple[str, str]]:
    """What people must have said before an edge begins, and have not."""
    note = now.drawing.note(edge)
    asked = note.get("confirm") or now.drawing.level(edge) == "shared"
    if asked and ("confirm", edge, "confirm") not in now.agreed:
        return [(edge, "a confirmation")]
    return []


def _is_expected(now: Situation, step: Step, event: Json) -> None:
    """Clauses 2 and 5: falls, rises, own function, in order; who goes along."""
    edge = event["address"]
    if step.plan is None:
        return
    number = len(step.started) - 1
    due = step.plan.starts[number] if number < len(step.plan.starts) else "nothing"
    fitting = [one for one in step.plans if one.starts[number : number + 1] == (edge,)]
    if not fitting:
        clause = 10 if edge in step.plan.along or due in step.plan.along else 5
        now.broken(clause, f"{edge} begins where {due} is due in {step.edge}")
        step.plans = []
        return
    step.plans = fitting
    assert step.plan is not None
    runs = edge in step.plan.begins
    human = now.drawing.level(edge) == "human"
    if runs and not human and not event["function"]:
        now.broken(2, f"{edge} ({now.drawing.kind(edge)}) has a function of its own and runs none")
    if event["function"] and (not runs or human):
        now.broken(2, f"{edge} ({now.drawing.kind(edge)}) runs a function, but none is due")


def begun(now: Situation, edge: str) -> None:
    """The world was told to begin the function of an edge."""
    step = now.step
    if step is None:
        now.broken(5, f"the function of {edge} begins, and no edge was said to be carried out")
        return
    if step.failed or (step.broken and not _ends_a_persons(now, edge)):
        clause = 9 if step.broken else 8
        now.broken(clause, f"the function of {edge} begins although {step.broken or step.failed}")
    if now.latched:
        now.broken(9, f"the function of {edge} begins although the run is {now.latched}")
    if edge not in step.started:
        now.broken(5, f"the function of {edge} begins before the edge is told")
    if step.running:
        now.broken(5, f"the function of {edge} begins while that of {step.running} runs")
    if now.drawing.level(edge) == "human" and ("operation", edge, "done") not in now.agreed:
        now.broken(4, f"{edge} is a person's, and nobody has done it")
    _own_source(now, step, edge)
    now.scene.forget(now.touched_by(edge))
    step.begun.append(edge)
    danger.goes_on(now, step, edge)
    step.acted.append(edge)
    step.running, step.running_since = edge, now.now
    if step.plan is not None:
        due = step.plan.begins
        number = len(step.begun) - 1
        if number >= len(due) or due[number] != edge:
            now.broken(5, f"the function of {edge} begins out of its order in {step.edge}")


def _ends_a_persons(now: Situation, edge: str) -> bool:
    """Whether the table only writes down what a person has done, who is let finish.

    Clause 9: what is lost triggers the operation's stop mode. One that declares ``finish`` goes on
    to its end, and a person's began when the person was asked.
    """
    lets_finish = now.drawing.note(edge).get("stop") == "finish"
    return lets_finish and now.drawing.level(edge) == "human"


def _own_source(now: Situation, step: Step, edge: str) -> None:
    """A later function of a step begins only where what it starts from is still known true."""
    name, source = edge.split("/")[:2]
    human = now.drawing.level(edge) == "human"
    if not human and now.scene.own_check(name, source, now.flags) is not True:
        now.broken(4, f"{name}/{source} does not check true, but the function of {edge} begins")
    if edge in now.shut and now.shut[edge] == "pruned":
        now.broken(4, f"{edge} is pruned, but its function begins")


def ended(now: Situation, edge: str, outcome: str) -> None:
    """The function of an edge ended, as the world has it or as it was told."""
    step = now.step
    if step is None or edge not in (step.running, step.cut_off):
        return
    step.running = ""
    step.ended[edge] = (outcome, now.now)
    now.disturbed = now.disturbed or outcome != "returned"
    if outcome == "returned":
        step.pending[edge.split("/", 1)[0]] = now.drawing.edges[edge][1]
        if now.drawing.kind(edge) == "load":
            put_below(now.drawing, edge, step.pending)


def watched(now: Situation) -> None:
    """Clause 9, at every tick: what running edges require, and critical facts."""
    step = now.step
    if step is None or step.broken or step.failed or step.over:
        return
    lost = now.required_lost(step.under_way)
    lost += [f"the critical fact {fact} is not known to be true" for fact in now.critical_lost()]
    if lost:
        step.broken, step.broken_at = f"{lost[0]} since t={now.now:g}", now.now
        return
    if step.running:
        limit = float(now.drawing.note(step.running).get("timeout") or LONGEST)
        if now.now - step.running_since > limit + 2.5 * TICK:
            now.broken(7, f"{step.running} runs for longer than its {limit:g} s")


def closed(now: Situation) -> None:
    """At the end of a tick: a step that must not go on is cut off, and is over once the world has
    settled."""
    step = now.step
    if step is None or not step.broken or now.latched or _finishes(now, step):
        return
    if step.running or now.now > step.broken_at + now.settle + HAIR:
        now.broken(9, f"{step.broken}, and {step.edge} goes on")
        now.step = None


def _finishes(now: Situation, step: Step) -> bool:
    """Whether what is under way declares that it is let finish before the run holds."""
    people = [edge for edge in step.started if now.drawing.level(edge) == "human"]
    last = step.running or (step.begun or people or [step.edge])[-1]
    if people and people[-1] == step.started[-1]:
        last = people[-1]
    return bool(now.drawing.note(last).get("stop") == "finish")


def refused(now: Situation, event: Json) -> None:
    """A guard said no to an operation that was asked for: there must be a reason."""
    edge, asked = event["address"], now.requested == event["address"]
    now.requested = ""
    if event.get("code") == "hazard":
        danger.refused(now, event, asked)
    if now.asked_while in ("held", "paused"):
        now.latched = now.asked_while
    if not now.configuration or now.step is not None or now.asked_while == "running":
        return
    if now.drawing.edges[edge][0] != now.configuration[edge.split("/")[0]]:
        return
    plan = now.carriage(edge, True)
    if plan is None or now.has_vetoes or now.drawing.can_fail or "code" in event:
        return
    if now.reviews.pop(edge, "allow") in ("veto", "prune"):
        return
    if now.critical_lost() or now.required_lost(list(plan.starts)) or now.drawing.peopled:
        return
    for one in plan.starts:
        name, source = one.split("/")[:2]
        there = now.configuration[name] == source
        if there and now.scene.check(name, source, now.configuration) is not True:
            return
    if any(_needs_of(now, one) for one in plan.starts):
        return
    now.broken(10, f"{edge} is permitted, and refused: {'; '.join(event['reasons'])}")
