"""What adding, deleting or moving a fact would do to the states, told before it is done."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.editing.digits import NEW, count_of, new_names, stand_beside
from smsl_studio.blueprint.editing.fact_table import read_table
from smsl_studio.blueprint.editing.fact_values import names_with, renamed_value
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import EditRefused
from smsl_studio.studio.base.words import counted, refusal_words, series


@dataclass(frozen=True)
class FactChange:
    """A change of the facts of an SB that waits for a yes.

    ``names`` are the states that change, each with its new name. The states of ``beside`` keep
    their names and get the value in ``_states``. ``fault`` is the reason why the change is not
    possible. ``asks`` names the text that the person types first. ``warning`` names what does not
    change with it. ``placed`` says what becomes of the values beside the names.
    """

    words: str
    verb: str
    step: str
    change: Callable[[Blueprint], Blueprint]
    names: tuple[tuple[str, str], ...] = ()
    beside: int = 0
    fault: str = ""
    asks: str = ""
    warning: str = ""
    placed: str = "the value stands beside"

    @property
    def ready(self) -> bool:
        """Whether it can be done as it is."""
        return not (self.fault or self.asks)

    @property
    def count(self) -> int:
        """The number of states that change."""
        return len(self.names) + self.beside

    @property
    def lines(self) -> tuple[str, ...]:
        """Each state that changes, with its name afterwards."""
        return tuple(f"{old} → {new}" for old, new in self.names)

    @property
    def sentence(self) -> str:
        """What it does, with the number of states."""
        if not self.ready:
            return self.fault or self.asks
        if self.beside:
            kept = counted(self.beside, "state keeps its name", "states keep their names")
            return f"{self.words} {kept}; {self.placed}. {self.warning}".rstrip()
        changed = counted(self.count, "state changes", "states change")
        return f"{self.words} {changed}. {self.warning}".rstrip()


def addition(branch: StateBranch, value: str) -> FactChange:
    """One more fact behind the others. ``value`` is what every state has of it; empty is ``0``."""
    digit, name = count_of(branch), branch.name
    order = [*range(digit), NEW]
    made = FactChange(
        f"Digit {digit} is added.",
        "Add fact",
        f"Add a fact to {name} as digit {digit}",
        lambda blueprint: editing.add_fact(blueprint, name, value),
    )
    return _told(made, branch, order, value)


def deletion(branch: StateBranch, digit: int) -> FactChange:
    """The fact is taken out."""
    order, name, fact = list(range(count_of(branch))), branch.name, branch.fact_name(digit)
    stands = stand_beside(branch)
    made = FactChange(
        f"“{fact}” is deleted." if stands else f"“{fact}” is taken out of the names.",
        "Delete fact",
        f"Delete {fact} of {name}",
        lambda blueprint: editing.delete_fact(blueprint, name, digit),
    )
    told = _told(made, branch, [one for one in order if one != digit])
    return replace(told, placed="its values beside them go") if stands else told


def move(branch: StateBranch, digit: int, place: int) -> FactChange:
    """The fact gets another digit."""
    order, name, fact = list(range(count_of(branch))), branch.name, branch.fact_name(digit)
    order.insert(place, order.pop(digit))
    made = FactChange(
        f"“{fact}” becomes digit {place}.",
        "Move fact",
        f"Move {fact} of {name} to digit {place}",
        lambda blueprint: editing.move_fact(blueprint, name, digit, place),
    )
    return _told(made, branch, order)


def renaming(
    branch: StateBranch, digit: int, sensors: Sequence[str], old: str, new: str
) -> FactChange:
    """The change of a value of the fact to another name.

    ``sensors`` are the sensors of plugins that read the fact. Their code still gives the old value,
    so the change has a warning.
    """
    name, fact = branch.name, branch.fact_name(digit)
    made = FactChange(
        f"“{old}” of “{fact}” becomes “{new}”.",
        "Rename",
        f"Rename value {old} of {fact} to {new}",
        lambda blueprint: editing.rename_value(blueprint, name, digit, old, new),
        warning=_stays(sensors, old, new),
    )
    if new in ("", old):
        return replace(made, asks=f"Another name for the value “{old}” of “{fact}”?")
    try:
        changes = renamed_value(branch, digit, old, new)
        names = names_with(branch, changes)
    except EditRefused as error:
        return replace(made, fault=refusal_words(error))
    if not names:
        return replace(made, beside=len(changes))
    return replace(made, names=tuple(names.items()))


def _stays(sensors: Sequence[str], old: str, new: str) -> str:
    """A warning about the code of sensors; empty if there are none."""
    if not sensors:
        return ""
    of = "its sensor" if len(sensors) == 1 else "its sensors"
    return (
        f"The code of {of} {series(sensors)} stays: if it says “{old}” and not “{new}”, no state "
        "agrees with it."
    )


def paste(branch: StateBranch, text: str) -> FactChange:
    """Facts filled from a table. Those that are missing are added."""
    count, name = count_of(branch), branch.name
    made = FactChange(
        "", "Paste", f"Paste facts into {name}", lambda bp: editing.fill_facts(bp, name, text)
    )
    try:
        rows = read_table(branch, text)
    except EditRefused as error:
        return replace(made, fault=refusal_words(error))
    missing = max(0, max(rows, default=-1) + 1 - count)
    filled = counted(len(rows), "fact is filled", "facts are filled")
    made = replace(made, words=f"{filled}, {missing} of them new.")
    return _told(made, branch, [*range(count), *[NEW] * missing]) if missing else made


def _told(made: FactChange, branch: StateBranch, order: list[int], value: str = "") -> FactChange:
    if stand_beside(branch):
        return replace(made, beside=len(branch.table))
    try:
        names = new_names(branch, order, value)
    except EditRefused as error:
        return replace(made, fault=refusal_words(error))
    return replace(made, names=tuple((old, new) for old, new in names.items() if old != new))
