"""A command as one row: its arguments, its refusals, its words and its effect."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, partial
from inspect import Signature, signature
from typing import TYPE_CHECKING, Any, Concatenate, Generic, ParamSpec, Protocol, overload

from smsl_studio.blueprint.address import Address

if TYPE_CHECKING:
    from smsl_studio.dispatch.drive.driver import Driver

P = ParamSpec("P")
PERSON = "a person"

STOP, TAKE_OVER, FAULT, TERMS, PAUSE, STEP, RUN = range(7)
"""The ranks: stop, take over, fault, veto, pause, step, run. ``TERMS`` is the rank of veto and of
all other commands about edges.
"""

EDGE, TEXT, AMOUNT, SWITCH, SENSED, DISTURBANCE, TASK = (
    "operation", "text", "amount", "switch", "sensed", "disturbance", "task",
)  # fmt: skip
"""The kinds of arguments: the address of an operation, a text, a number from 0 on, yes or no, a
sensor or a fact, a kind of disturbance, a kind of task.
"""


@dataclass(frozen=True, slots=True)
class Argument:
    """One argument of a command. ``scripted`` says that a script may give it."""

    kind: str
    needed: bool = True
    scripted: bool = True


@dataclass(frozen=True, slots=True)
class Command:
    """A command that somebody (``by``) gave: its row in the table, and its arguments by name."""

    row: CommandRow
    by: str = PERSON
    said: Mapping[str, Any] = field(default_factory=dict)

    @property
    def word(self) -> str:
        """The word of the command."""
        return self.row.word

    @property
    def address(self) -> Address | None:
        """The operation of the command, or None if it is about none."""
        found: Address | None = self.said.get("address") if self.row.names_edge else None
        return found

    @property
    def value(self) -> str:
        """The value of the command in the record."""
        return self.row.value.format_map({key: _text(one) for key, one in self.said.items()})

    @property
    def reason(self) -> str:
        """The reason that was given."""
        return str(self.said["reason"]) if "reason" in self.row.arguments else ""


class Listener(Protocol):
    """An object that takes commands."""

    def take(self, command: Command) -> None:
        """Keep a command for the next tick."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandRow:
    """A command of the table.

    ``refused`` has the run states that always refuse it, each with the reason; ``{by}`` is the
    person who has taken over. ``sentence`` is the sentence of an account, and ``sentences`` has
    those for special values; ``{address}`` and ``{value}`` are from the command. ``owes`` is the
    event that must follow if it was carried out. ``explains`` are the events that are attributed to
    the person who gave it.

    ``effect`` carries it out, and returns why it was not done, or the empty text. ``arguments`` are
    its arguments, and ``free`` allows any others. ``script_words`` are its words in a script, each
    with the arguments that the word contains. ``value`` is the format of its arguments in the
    record. ``about`` finds the operation if none was named.

    Of the commands of one tick, those with a smaller ``rank`` come first. A command that
    ``sets_going`` is refused if one that ``holds_back`` came before it in the same tick. ``stands``
    says that such a command holds back even if it changes nothing. ``useless`` has the run states
    in which the effect itself refuses it; ``middle`` means the middle of an operation.

    ``supervisors`` says that a supervisor may decide it for an operation. ``label``, ``key`` and
    ``icon`` belong to its button. A command with a ``tip`` is in the Run menu. ``question`` and
    ``consequence`` are the words of a second question, and ``verb`` those of its button (by default
    the label); ``{name}`` is the operation. ``offer`` is the sentence with which a run offers it,
    and ``offered`` are the run states in which it always does so. ``offers`` decides about others.
    """

    word: str = field(kw_only=False)
    effect: Callable[..., str] = field(kw_only=False)
    refused: Mapping[str, str] = field(default_factory=dict)
    sentence: str = ""
    sentences: Mapping[str, str] = field(default_factory=dict)
    owes: str = ""
    explains: tuple[str, ...] = ()
    arguments: Mapping[str, Argument] = field(default_factory=dict)
    free: bool = False
    script_words: Mapping[str, Mapping[str, Any]] | None = None
    value: str = ""
    about: Callable[[Driver], Address | None] | None = None
    rank: int = RUN
    sets_going: bool = False
    holds_back: bool = False
    stands: bool = False
    useless: tuple[str, ...] = ()
    supervisors: bool = False
    label: str = ""
    key: str = ""
    icon: str = ""
    tip: str = ""
    verb: str = ""
    question: str = ""
    consequence: str = ""
    offer: str = ""
    offered: tuple[str, ...] = ()

    def command(self, *args: Any, **kwargs: Any) -> Command:
        """Return the command with its arguments. TypeError if they do not fit the effect."""
        parameters = _signature(self.effect)
        bound = parameters.bind(*args, **kwargs)
        bound.apply_defaults()
        said = dict(bound.arguments)
        free = next((p.name for p in parameters.parameters.values() if p.kind is p.VAR_KEYWORD), "")
        others = said.pop(free, {})
        by = said.pop("by", PERSON)
        return Command(self, by, {**said, **others})

    @property
    def names_edge(self) -> bool:
        """Whether the command is about an operation."""
        address = self.arguments.get("address")
        return address is not None and address.kind == EDGE

    @property
    def must_name(self) -> bool:
        """Whether the command always names an operation if it is carried out."""
        return self.names_edge and self.arguments["address"].needed

    @property
    def may_name(self) -> bool:
        """Whether the command may name an operation."""
        return self.names_edge or self.supervisors

    @property
    def has_value(self) -> bool:
        """Whether the command has a value in the record."""
        return bool(self.value)

    def why_refused(self, phase: str, by: str) -> str:
        """Return why a run state refuses it, or the empty text. ``by`` has taken over."""
        return self.refused.get(phase, "").format(by=by[:1].upper() + by[1:])

    def told(self, address: str, value: str) -> str:
        """Return the sentence of an account."""
        return self.sentences.get(value, self.sentence).format(address=address, value=value)

    @property
    def reasoned(self) -> bool:
        """Whether the command needs a reason."""
        return "reason" in self.arguments and self.arguments["reason"].needed

    def doing(self, name: str) -> str:
        """Return the words of the button that does it to an operation."""
        return (self.verb if name else "").format(name=name) or self.label

    def asking(self, name: str) -> str:
        """Return the second question before it is done."""
        return self.question.format(name=name) or f"{self.doing(name)}?"

    @property
    def words(self) -> Mapping[str, Mapping[str, Any]]:
        """The words of the command in a script, each with the arguments that the word contains."""
        return {self.word: {}} if self.script_words is None else self.script_words

    def takes(self, phase: str, carrying: bool = False) -> bool:
        """Return whether a run state takes it. ``carrying`` means the middle of an operation."""
        return phase not in self.refused and ("middle" if carrying else phase) not in self.useless


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandMethod(CommandRow, Generic[P]):
    """A row that is also a method of everything that takes commands, with the parameters of its
    effect.
    """

    effect: Callable[Concatenate[Driver, P], str] = field(kw_only=False)

    def __set_name__(self, owner: type, name: str) -> None:
        if name != self.word:
            raise TypeError(f"the command {self.word!r} stands as {name!r} in the table")

    @overload
    def __get__(self, dispatcher: None, owner: type) -> CommandRow: ...
    @overload
    def __get__(self, dispatcher: Listener, owner: type) -> Callable[P, None]: ...
    def __get__(self, dispatcher: Listener | None, owner: type) -> CommandRow | Callable[P, None]:
        return self if dispatcher is None else partial(self._say, dispatcher)

    def _say(self, dispatcher: Listener, *args: P.args, **kwargs: P.kwargs) -> None:
        dispatcher.take(self.command(*args, **kwargs))


def in_order(commands: Iterable[Command]) -> list[Command]:
    """Return the commands of one tick in order of rank. Those of equal rank keep their order."""
    return sorted(commands, key=lambda command: command.row.rank)


@cache
def _signature(effect: Callable[..., str]) -> Signature:
    """Return the parameters of an effect without its driver."""
    found = signature(effect)
    return found.replace(parameters=[*found.parameters.values()][1:])


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return str(float(value)) if isinstance(value, int | float) else str(value)
