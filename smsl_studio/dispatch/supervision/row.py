"""One command as one row: what is said with it, when it is refused, how it reads, what it does."""

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
"""Ranks: stop > take over > fault > veto > pause > step > run. ``TERMS`` is veto and all else that
is said about edges."""

EDGE, TEXT, AMOUNT, SWITCH, SENSED, DISTURBANCE, TASK = (
    "operation", "text", "amount", "switch", "sensed", "disturbance", "task",
)  # fmt: skip
"""What an argument is: the address of an operation, a text, a number from 0 on, yes or no, a sensor
or a fact, a kind of disturbance, a kind of task."""


@dataclass(frozen=True, slots=True)
class Argument:
    """What is said with a command. ``scripted``: a script may say it."""

    kind: str
    needed: bool = True
    scripted: bool = True


@dataclass(frozen=True, slots=True)
class Command:
    """What somebody (``by``) said to a run: a row of the table, with its arguments by name."""

    row: CommandRow
    by: str = PERSON
    said: Mapping[str, Any] = field(default_factory=dict)

    @property
    def word(self) -> str:
        """What it is called."""
        return self.row.word

    @property
    def address(self) -> Address | None:
        """The operation that it is about, where it is about one."""
        found: Address | None = self.said.get("address") if self.row.names_edge else None
        return found

    @property
    def value(self) -> str:
        """What the record has as its value."""
        return self.row.value.format_map({key: _text(one) for key, one in self.said.items()})

    @property
    def reason(self) -> str:
        """Why it was said."""
        return str(self.said["reason"]) if "reason" in self.row.arguments else ""


class Listener(Protocol):
    """Whoever takes commands."""

    def take(self, command: Command) -> None:
        """Have a command wait for the next tick."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandRow:
    """A command.

    ``refused`` has the run states that refuse it whatever is said with it, each with the reason
    (``{by}`` is who has taken over). ``sentence`` is what an account says of it; ``sentences`` are
    those that hang on its value. ``{address}`` and ``{value}`` are what was said with it. ``owes``
    is the event that must follow where it was carried out, ``explains`` are the events that are
    told in the name of whoever commanded it.

    ``effect`` carries it out, and answers why it was not done, empty where it was. ``arguments``
    are what people say with it, ``free`` says that any other may stand with them; a script knows
    it by ``script_words``, each with what that word says by itself. ``value`` is how the record
    words the arguments. ``about`` finds the operation where none was named.

    Of the commands of one tick, those of a smaller ``rank`` count first. ``sets_going``: it is
    refused where one that ``holds_back`` came before it at the same tick; ``stands``: such a one
    holds back even where it changes nothing. ``useless`` are the run states, and ``middle``
    for the middle of an operation, in which the effect itself refuses it.

    ``supervisors``: a supervisor may decide it of an operation. ``label``, ``key`` and ``icon``
    are those of its button; one with a ``tip`` stands in the Run menu. It is asked once more by
    ``question`` and ``consequence``, and ``verb`` does it (by default the label): ``{name}`` is the
    operation. ``offer`` is the sentence where the run offers it.
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

    def command(self, *args: Any, **kwargs: Any) -> Command:
        """The command with its arguments; TypeError where they are not those of its effect."""
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
        """Whether it is about an operation."""
        address = self.arguments.get("address")
        return address is not None and address.kind == EDGE

    @property
    def must_name(self) -> bool:
        """Whether it names an operation wherever it is carried out."""
        return self.names_edge and self.arguments["address"].needed

    @property
    def may_name(self) -> bool:
        """Whether it may name one."""
        return self.names_edge or self.supervisors

    @property
    def has_value(self) -> bool:
        """Whether the record has a value of it."""
        return bool(self.value)

    def why_refused(self, phase: str, by: str) -> str:
        """Why a run state refuses it; ``by`` has taken over. Empty where the state does not."""
        return self.refused.get(phase, "").format(by=by[:1].upper() + by[1:])

    def told(self, address: str, value: str) -> str:
        """What an account says of it; empty where it has no words for such a value."""
        return self.sentences.get(value, self.sentence).format(address=address, value=value)

    @property
    def reasoned(self) -> bool:
        """Whether it is said with a reason."""
        return "reason" in self.arguments and self.arguments["reason"].needed

    def doing(self, name: str) -> str:
        """What the button says that does it to an operation."""
        return (self.verb if name else "").format(name=name) or self.label

    def asking(self, name: str) -> str:
        """How it is asked once more."""
        return self.question.format(name=name) or f"{self.doing(name)}?"

    @property
    def words(self) -> Mapping[str, Mapping[str, Any]]:
        """The words by which a script knows it, each with what it says by itself."""
        return {self.word: {}} if self.script_words is None else self.script_words

    def takes(self, phase: str, carrying: bool = False) -> bool:
        """Whether a run state takes it; ``carrying``: in the middle of an operation."""
        return phase not in self.refused and ("middle" if carrying else phase) not in self.useless


@dataclass(frozen=True, kw_only=True, eq=False)
class CommandMethod(CommandRow, Generic[P]):
    """A row that is a method of whoever takes commands, with the parameters of its effect."""

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
    """The commands of one tick as they count: by rank, and as they came."""
    return sorted(commands, key=lambda command: command.row.rank)


@cache
def _signature(effect: Callable[..., str]) -> Signature:
    """The parameters of an effect without its driver."""
    found = signature(effect)
    return found.replace(parameters=[*found.parameters.values()][1:])


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return str(float(value)) if isinstance(value, int | float) else str(value)
