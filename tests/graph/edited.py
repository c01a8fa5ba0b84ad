"""Random edits of random SBs, each followed by a tidy drawing."""

from __future__ import annotations

from random import Random

from smsl_studio.blueprint.elements import Header
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.layout import place_states
from smsl_studio.graph.tidied import tidied

Places = dict[str, tuple[float, float]]


def random_branch(chance: Random) -> StateBranch:
    """Return an SB of 8 to 20 states, each with a way to it from an earlier one, and some more
    operations.
    """
    size = chance.randrange(8, 21)
    table: dict[str, dict[str, str]] = {f"State_{i}": {} for i in range(size)}
    for i in range(1, size):
        table[f"State_{chance.randrange(i)}"][f"go_{i}"] = f"State_{i}"
    for i in range(size // 2):
        table[f"State_{chance.randrange(size)}"][f"more_{i}"] = f"State_{chance.randrange(size)}"
    return StateBranch("SB", dict(table), Header(initial="State_0"))


def edited(
    branch: StateBranch, places: Places, chance: Random
) -> tuple[StateBranch, Places, list[float]]:
    """Add or delete a state or an operation, and tidy. Return the SB, its places, and how far each
    state moved that the edit did not touch.
    """
    table = {name: dict(operations) for name, operations in branch.table.items()}
    names = list(table)
    what = chance.randrange(4)
    number = 1 + max(int(name.removeprefix("State_")) for name in names)
    touched: set[str] = set()
    if what == 0:
        touched = {f"State_{number}", chance.choice(names)}
        table[f"State_{number}"] = {}
        table[min(touched & set(names))][f"new_{number}"] = f"State_{number}"
    elif what == 1 and len(names) > 5:
        gone = chance.choice(names[1:])
        touched = {gone}
        del table[gone]
        table = {n: {o: t for o, t in own.items() if t != gone} for n, own in table.items()}
    elif what < 3 or not any(table.values()):
        a, b = chance.sample(names, 2)
        touched = {a, b}
        table[a][f"extra_{len(table[a])}_{number}"] = b
    else:
        a = chance.choice([name for name in names if table[name]])
        operation = chance.choice(list(table[a]))
        touched = {a, table[a].pop(operation)}
    after = StateBranch("SB", dict(table), branch.header)
    former = {name: at for name, at in places.items() if name in table}
    shown = place_states(after, former)
    tidy = tidied(after, shown)
    far = [
        max(abs(tidy[name][0] - x), abs(tidy[name][1] - y))
        for name, (x, y) in former.items()
        if name not in touched
    ]
    return after, tidy, far or [0.0]
