"""What the automaton remembers of a log: the state of the run, and what must still follow."""

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
from smsl_studio.runlog.log import FORMER

Json = Any


SHORT = 200
"""Characters of an address that is looked at once and remembered; longer ones are split anew."""


def parts(text: str) -> tuple[str, ...]:
    """The names in an address; the empty tuple where there are more than three, or one is empty."""
    return _parts(text) if len(text) <= SHORT else _split(text)


def _split(text: str) -> tuple[str, ...]:
    address = Address.read(text)
    return address.path if address is not None else ()


_parts = lru_cache(maxsize=4096)(_split)


@dataclass(slots=True)
class Begun:
    """An operation that has begun and is not committed. ``outcome`` is how its function ended,
    empty as long as it has not; ``done`` says that the check of its target was true, ``person``
    that a person was asked to carry it out, ``since`` when it began."""

    branch: str
    source: str
    target: str
    function: str
    outcome: str = ""
    done: bool = False
    person: bool = False
    since: float = 0.0


@dataclass(slots=True)
class Asked:
    """A task that is open: who has answered it, and whether another role was asked as well."""

    opened: run.TaskOpened
    answered: dict[str, None] = field(default_factory=dict)
    escalated: bool = False


class Memory:
    """A story up to now.

    ``fold`` is how the run stands, ``last`` the newest event, ``now`` the time of the one that is
    judged. ``commands`` are those that there are. ``unchecked`` are the SBs whose state check at
    the start is still to come.

    Of the step that is carried out: ``begun`` are its operations, ``newest`` the last one of each
    SB, ``pending`` the SBs that it has left elsewhere. ``acting`` says that a function or a person
    is at work, ``failing`` that nothing of it can commit any more, ``stepped`` that a step was
    carried out since the run was located or planned its way. ``checked`` are the true state checks
    that stand directly before the next event, ``committed`` is when the step committed last.

    Of regulation: ``cause`` is the newest command, ``owed`` the word of the event that must follow
    it, ``asked`` the operation that somebody chose, ``shut`` those that may not begin. ``doomed``
    says that the run can only fail now. ``tasks`` are the open tasks and ``names`` all that ever
    were; ``declined`` says that somebody was asked whether the run shall start, and answered.

    ``evidence`` is what the facts that were told say of states, ``expansion`` which digits of
    bases stand for sub-SBs. ``rests`` says that a pause came where a step had committed in part,
    and may go on. ``busy`` is when anything else was told last than what a look at the goals
    tells: facts, costs and goals. ``chosen`` says that the
    step which is carried out was asked for, and is on no route. ``former`` says that the log is of
    the version before, whose runs told goals without looking anew.

    ``wanted_pause`` says that a pause or a step was commanded since the run paused last, ``let_go``
    that somebody has said something since it held, ``blames`` that an operation has failed and is
    still to be tagged risky.

    ``goal_of`` has the goal of each SB and its state, ``standing`` are the SBs that stand there.
    ``reached`` are the goals that were told, in their order, ``away`` the SBs that have left such a
    goal since.
    """

    def __init__(self, header: Mapping[str, Json], commands: CommandWords) -> None:
        by_hand = header.get("by_hand") is True
        self.header, self.commands = header, commands
        self.fold = RunFold(by_hand=by_hand)
        self.last: Event | None = None
        self.now = 0.0
        self.unchecked: dict[str, str] = {}
        self.begun: dict[str, Begun] = {}
        self.newest: dict[str, Begun] = {}
        self.pending: dict[str, str] = {}
        self.acting = self.failing = self.stepped = self.doomed = False
        self.checked: dict[str, str] = {}
        self.committed: float | None = None
        self.cause: run.Commanded | None = None
        self.owed = ""
        self.asked = ""
        self.shut = set(texts(header.get("avoid")))
        self.tasks: dict[str, Asked] = {}
        self.names: set[str] = set()
        self.declined = False
        self.evidence = Evidence(header.get("grounds"))
        self.expansion = Expansion(header.get("grounds"))
        self.rests = False
        self.former = header.get("version") == FORMER
        self.busy = -1.0
        self.chosen = False
        self.standing: set[str] = set()
        self.wanted_pause = self.blames = self.let_go = False
        self.goal_of: dict[str, tuple[str, str]] = {}
        self.reached: dict[str, None] = {}
        self.away: set[str] = set()

    def stands(self, branch: str) -> str:
        """The state of an SB, committed or pending; empty where there is no such SB."""
        return self.pending.get(branch) or self.fold.configuration.get(branch, "")

    def knows(self, branch: str) -> bool:
        """Whether the run has such an SB; before it has begun nobody knows."""
        return not self.fold.begun or branch in self.fold.configuration

    def is_configuration(self, states: Mapping[str, str]) -> bool:
        """Whether these are the run's SBs, all of them and no others, each in a state."""
        here = self.fold.configuration
        return all(states.values()) and (not here or states.keys() == here.keys())

    def caused(self, word: str, by: str | None = None, address: str | None = None) -> bool:
        """Whether the newest command was this one, given at this moment and carried out."""
        one = self.cause
        if one is None or one.command != word or one.t != self.now:
            return False
        # A world may die in the middle of a command, when it has had some of its effects.
        done = bool(self.owed) if not one.refused else one.refused.startswith(WORLD_GONE)
        return done and by in (None, one.by) and address in (None, one.address)

    @property
    def may_go_on(self) -> bool:
        """Whether a single step has committed at this moment, and may not be over: a fall that is
        the last crossing of its base commits with it, and the rest of the sub's way follows
        singly. No event says whether there is a rest."""
        return self.committed == self.now and self.fold.phase in ("ready", "paused")

    def end_step(self) -> None:
        """Forget what was being carried out."""
        self.begun, self.newest, self.pending = {}, {}, {}
        self.acting = self.failing = self.stepped = self.blames = self.rests = False
        self.committed = None


WORLD_GONE = "the world is gone"


def texts(value: Json) -> tuple[str, ...]:
    """The texts of a list in a header, which may be anything."""
    found = value if isinstance(value, list) else ()
    return tuple(one for one in found if isinstance(one, str))
