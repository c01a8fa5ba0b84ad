"""Planning problems whose objects, beginning and goal are drawn, for eight domains."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from smsl_studio.shipped import samples_dir

_SAMPLES, _OWN = samples_dir() / "pddl", Path(__file__).parent / "planning"


def domain_file(name: str) -> Path:
    """The file of a domain."""
    shipped = _SAMPLES / f"{name}.pddl"
    return shipped if shipped.exists() else _OWN / f"{name}.pddl"


def drawn_problem(domain: str, rng: random.Random) -> str:
    """The text of a problem of a domain."""
    objects, init, goal = _DRAWN[domain](rng)
    return (f"(define (problem p) (:domain {domain}) (:objects {objects})\n"
            f"  (:init {' '.join(init)})\n  (:goal {goal}))\n")  # fmt: skip


Problem = tuple[str, Iterable[str], str]


def _pairs(rng: random.Random, names: Sequence[str], word: str, share: float) -> list[str]:
    return [f"({word} {a} {b})" for a in names for b in names if a != b and rng.random() < share]


def _some(rng: random.Random, names: Iterable[str], word: str) -> list[str]:
    return [f"({word} {one})" for one in names if rng.random() < 0.5]


def _named(letter: str, many: int) -> list[str]:
    return [f"{letter}{n}" for n in range(many)]


def _lamps(rng: random.Random) -> Problem:
    lamps = _named("l", rng.randint(1, 4))
    init = [*_some(rng, lamps, "lit"), *_pairs(rng, lamps, "wired", 0.3), "(power)"]
    return f"{' '.join(lamps)} - lamp", init, f"(lit {rng.choice(lamps)})"


def _trays(rng: random.Random) -> Problem:
    boxes = _named("b", rng.randint(1, 3))
    init = ["(empty)"]
    for at, box in enumerate(boxes):
        other = rng.choice([None, *boxes[:at]])
        free = f"(free {other})"
        if free in init:
            init.remove(free)
            init.append(f"(on {box} {other})")
        else:
            init.append(f"(on-table {box})")
        init.append(f"(free {box})")
    return f"{' '.join(boxes)} - box", init, f"(or (holds {boxes[-1]}) (not (empty)))"


def _ward(rng: random.Random) -> Problem:
    rooms, keys = _named("r", rng.randint(1, 3)), _named("k", rng.randint(1, 2))
    every = ["depot", *rooms]
    init = [f"(at {rng.choice(every)})", *_pairs(rng, every, "beside", 0.5)]
    init += [] if "(beside depot r0)" in init else ["(beside depot r0)"]
    for room in rooms:
        if rng.random() < 0.5:
            init += [f"(locked {room})", f"(opens {rng.choice(keys)} {room})"]
        init += [f"(wet {room})"] if room != "r0" and rng.random() < 0.1 else []
    init += [f"(lies {key} {rng.choice(every)})" for key in keys]
    init += [f"(= (steps {a} {b}) {rng.choice([1, 2.5, 4])})" for a in every for b in every]
    return f"{' '.join(rooms)} - room {' '.join(keys)} - key", init, f"(at {rng.choice(rooms)})"


def _crew(rng: random.Random) -> Problem:
    nurses, places = _named("n", rng.randint(1, 2)), _named("x", 2)
    people = ["ada", *nurses]
    init = [f"(stands {one} {rng.choice(places)})" for one in people]
    init += ["(sink x0)", "(table x1)"]
    init += _some(rng, people, "clean")
    return (
        f"ada - surgeon {' '.join(nurses)} - nurse x0 x1 - place",
        init,
        "(exists (?p - person) (gowned ?p))",
    )


def _beds(rng: random.Random) -> Problem:
    patients, beds = _named("p", rng.randint(1, 2)), _named("b", rng.randint(2, 3))
    init = [f"(at {one} {bed})" for one, bed in zip(patients, rng.sample(beds, 2), strict=False)]
    init += ["(at w hall)", *_some(rng, beds, "isolated"), *_some(rng, patients, "ill")]
    goal = f"(and (not (ill {patients[0]})) (at w hall))"
    return f"{' '.join(beds)} - bed w - porter {' '.join(patients)} - patient", init, goal


def _valves(rng: random.Random) -> Problem:
    small, large = _named("s", rng.randint(1, 2)), _named("l", rng.randint(1, 2))
    every = [*small, *large]
    init = [*_pairs(rng, every, "against", 0.2), *_some(rng, every, "open"), "(= (once) 3)"]
    init += [f"(= (effort {one}) {rng.randint(0, 4)})" for one in every]
    goal = rng.choice(["(rinsed)", "(forall (?v - valve) (not (open ?v)))", "(pressure)"])
    return f"{' '.join(large)} - large {' '.join(small)} - small", init, goal


def _shelf(rng: random.Random) -> Problem:
    things, places = _named("t", rng.randint(1, 2)), _named("p", rng.randint(2, 4))
    init = [f"(thing {one})" for one in things] + [f"(place {one})" for one in places]
    for one, place in zip(things, rng.sample(places, len(things)), strict=True):
        init += [f"(in {one} {place})", f"(full {place})"]
    init += [*_pairs(rng, places, "next", 0.3), "(idle)"]
    goal = f"(in {rng.choice(things)} {rng.choice(places)})"
    return " ".join([*places, *things]), init, goal


def _signals(rng: random.Random) -> Problem:
    nodes = _named("n", rng.randint(1, 2))
    every = ["source", *nodes]
    init = [*_pairs(rng, every, "wire", 0.5), *_some(rng, every, "on"), *_some(rng, nodes, "stuck")]
    goal = rng.choice([f"(on {nodes[-1]})", "(forall (?n - node) (on ?n))", "(not (on source))"])
    return f"{' '.join(nodes)} - node", init, goal


_DRAWN: dict[str, Callable[[random.Random], Problem]] = {
    "trays": _trays, "ward": _ward, "lamps": _lamps, "crew": _crew,
    "beds": _beds, "valves": _valves, "shelf": _shelf, "signals": _signals,
}  # fmt: skip
DOMAINS = tuple(_DRAWN)
