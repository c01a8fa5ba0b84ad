"""The state of the automaton: the state of the run, and the events that must still follow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.fold import RunFold
from smsl_studio.runlog.grammar.evidence import Evidence
from smsl_studio.runlog.grammar.expansion import Expansion
from smsl_studio.runlog.grammar.known_operations import KnownOperations
from smsl_studio.runlog.log import FORMER

Json = Any


SHORT = 200
"""The largest number of characters of an address that is cached."""


def parts(text: str) -> tuple[str, ...]:
    """Return the names in an address. Empty if there are more than three, or if one is empty."""
    return _parts(text) if len(text) <= SHORT else _split(text)


def _split(text: str) -> tuple[str, ...]:
    address = Address.read(text)
    return address.path if address is not None else ()


_parts = lru_cache(maxsize=4096)(_split)


@dataclass(slots=True)
class Begun:
    """An operation that has begun and is not committed.

    ``outcome`` is the outcome of its function, empty until it ends. ``done`` says that the check of
    its target was true. ``person`` says that a person was asked to carry it out. ``must_end`` says
    that a function or a person must carry it out, and not its sub-SBs alone. ``since`` is the
    simulated time (s) of its beginning.
    """

    branch: str
    source: str
    target: str
    function: str
    outcome: str = ""
    done: bool = False
    person: bool = False
    must_end: bool = False
    since: float = 0.0
    times: int = 1

    @property
    def is_carried(self) -> bool:
        """Whether a function or a person carries it out, as far as the log tells."""
        return bool(self.function) or self.person or self.must_end


@dataclass(slots=True)
class Asked:
    """An open task: who has answered it, and whether another role was asked too."""

    opened: run.TaskOpened
    answered: dict[str, None] = field(default_factory=dict)
    escalated: bool = False


class Memory:
    """The state of the automaton after the events so far. Times are simulated seconds.

    ``fold`` is the state of the run, ``last`` the newest event, and ``now`` the time of the event
    that is judged. ``commands`` are all commands. ``unchecked`` are the SBs whose state check at
    the start is still to come. ``former`` says that the log has the former version, which told
    goals without a fresh check. ``unattended`` says that nobody can decide when the run holds.

    Of the step that is carried out: ``begun`` are its operations, ``newest`` is the last operation
    of each SB, and ``pending`` has the SBs that have moved and are not committed. ``acting`` says
    that a function or a person is at work. ``failing`` says that nothing of the step can commit any
    more. ``blames`` says that an operation has failed and must still be tagged risky. ``stepped``
    says that an operation has begun since the run was located, planned its route or reached a goal.
    ``checked`` are the true state checks directly before the next event. ``unproved`` are the
    states that must check true before the step goes on, and ``proved`` the SBs whose check was true
    since an operation has ended. ``ended`` is the operation that has ended last, and ``risk`` the
    newest tag of a risk since the run was located or held. ``committed`` is the time
    of the step's last commit. ``rests`` says that the run was paused after a part of a step had
    committed, so the rest may go on. ``chosen`` says that somebody asked for the step, so it is on
    no route.

    Of regulation: ``cause`` is the newest command, and ``owed`` is the word of the event that it
    must cause. ``asked`` is the operation that somebody chose, and ``shut`` are those that must
    not begin. ``doomed`` says that the run can only fail now. ``tasks`` are the open tasks, and
    ``names`` the names of all tasks so far. ``declined`` says that somebody has answered the
    question whether the run may start. ``wanted_pause`` says that a pause or a step was commanded
    since the last pause, ``below_holds`` that what an operation runs holds. ``let_go`` says that a
    command was given or a task closed since the last hold.

    Of facts and goals: ``evidence`` compares the logged facts with states, ``expansion`` has the
    digits that sub-SBs expand, and ``known`` the functions and costs of operations. ``busy`` is the
    time of the last event that is not a fact, a cost or a goal. ``goal_of`` has the goal of each SB
    and its state, and ``standing`` are the SBs that are there. ``reached`` are the goals that were
    told, in order, and ``away`` the SBs that have left such a goal since. ``endangered`` says that
    a hazard was met since the last hold. ``foreseen`` are the operations that had a forecast.
    """

    def __init__(self, header: Mapping[str, Json], commands: CommandWords) -> None:
        by_hand = header.get("by_hand") is True
        self.header, self.commands = header, commands
        self.fold = RunFold(by_hand=by_hand)
        self.last: Event | None = None
        self.below_holds = False
        self.now = 0.0
        self.unchecked: dict[str, str] = {}
        self.begun: dict[str, Begun] = {}
        self.newest: dict[str, Begun] = {}
        self.pending: dict[str, str] = {}
        self.acting = self.failing = self.stepped = self.doomed = False
        self.checked: dict[str, str] = {}
        self.unproved: dict[str, str] = {}
        self.proved: set[str] = set()
        self.ended: run.OperationEnded | None = None
        self.risk: run.OperationRisky | None = None
        self.committed: float | None = None
        self.cause: run.Commanded | None = None
        self.owed = ""
        self.asked = ""
        self.shut = set(texts(header.get("avoid")))
        self.guarded: set[str] = set()
        """The operations that a guard of the plugin closes now."""
        self.tasks: dict[str, Asked] = {}
        self.names: set[str] = set()
        self.declined = False
        self.evidence = Evidence(header.get("grounds"))
        self.expansion = Expansion(header.get("grounds"))
        self.known = KnownOperations(header.get("grounds"))
        self.unattended = header.get("attended") is False
        self.rests = False
        self.former = header.get("version") == FORMER
        self.busy = -1.0
        self.chosen = False
        self.standing: set[str] = set()
        self.wanted_pause = self.blames = self.let_go = self.endangered = False
        self.goal_of: dict[str, tuple[str, str]] = {}
        self.reached: dict[str, None] = {}
        self.away: set[str] = set()
        self.foreseen: set[str] = set()
        self.allowed = ("", -1.0)
        """The edge that the newest closed question about a generated one was about, and when."""

    def stands(self, branch: str) -> str:
        """Return the state of an SB, committed or pending. Empty if there is no such SB."""
        return self.pending.get(branch) or self.fold.configuration.get(branch, "")

    def knows(self, branch: str) -> bool:
        """Return whether the run has this SB. Before the beginning every SB is possible."""
        return not self.fold.begun or branch in self.fold.configuration

    def is_configuration(self, states: Mapping[str, str]) -> bool:
        """Return whether these are all SBs of the run and no others, each with a state."""
        here = self.fold.configuration
        return all(states.values()) and (not here or states.keys() == here.keys())

    def caused(self, word: str, by: str | None = None, address: str | None = None) -> bool:
        """Return whether the newest command is this one, was given at this time and was carried
        out.
        """
        one = self.cause
        if one is None or one.command != word or one.t != self.now:
            return False
        # If the world dies during a command, the command is refused, but some of its effects have
        # happened.
        done = bool(self.owed) if not one.refused else one.refused.startswith(WORLD_GONE)
        return done and by in (None, one.by) and address in (None, one.address)

    @property
    def may_go_on(self) -> bool:
        """Whether a single step has committed at this time, and may still go on. A fall that is the
        last crossing of its base commits with it, and the rest of the sub-SB's path follows step by
        step. No event says whether there is a rest.
        """
        return self.committed == self.now and self.fold.phase in ("ready", "paused")

    def end_step(self) -> None:
        """Forget the step that was being carried out."""
        self.begun, self.newest, self.pending = {}, {}, {}
        self.unproved, self.proved = {}, set()
        self.acting = self.failing = self.stepped = self.blames = self.rests = False
        self.committed = None


WORLD_GONE = "the world is gone"


def texts(value: Json) -> tuple[str, ...]:
    """Return the texts in a list of a header. The value may be anything."""
    found = value if isinstance(value, list) else ()
    return tuple(one for one in found if isinstance(one, str))
