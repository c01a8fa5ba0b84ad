"""Hazards and properties: answers against brute force, and how long large spaces take.

A case is a random blueprint of one to three levels with twelve properties of the kinds that look at
configurations (``tests/inspection/proof/test_proof.py``). Each is answered by brute force, which
shares no code with the program, and in three ways by the program: one by one, one by one in the
cone of influence, and as one set. With ``--all`` there are 20,000 cases, seeds 100000 to 119999;
``--seeds=A:B`` runs a part of them, and nothing else. The whole command is measured for the large
spaces. For the samples, all rules and all properties are measured in this process, so without its
start.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from random import Random
from typing import Any

from benches.row import Row, median_ms, process_ms
from benches.seeds import chosen, is_part
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.proof import prove
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form import parse_json
from tests.inspection.proof.test_proof import judge

CASES, ALL, FIRST = 60, 20_000, 100_000
SOON = "at most 2,000 ms"
SAMPLES = Path(__file__).parent.parent / "samples"


def rows() -> Iterator[Row]:
    """A share of the cases, and the large spaces."""
    yield from _rows(CASES)


def all_rows() -> Iterator[Row]:
    """All cases, and the large spaces."""
    yield from _rows(ALL)


def _rows(cases: int) -> Iterator[Row]:
    yield from _judged(cases)
    if not is_part():
        yield from _samples()
        yield from _large()


def _judged(most: int) -> Iterator[Row]:
    wrong = answers = cases = 0
    for seed in chosen("proof", FIRST, most):
        cases += 1
        try:
            answers += judge(seed)
        except AssertionError as error:
            print(f"case {seed}: {error}", file=sys.stderr, flush=True)
            wrong += 1
    work = f"{cases:,} random blueprints, {answers:,} answers: blueprints with a wrong one"
    yield Row(work, wrong, "", bound="0")


def _samples() -> Iterator[Row]:
    """Each sample, with the three files of the paper among them; nothing is kept between runs."""
    spent = []
    for file in sorted(SAMPLES.glob("*.json")):
        document = parse_json(file.read_text("utf-8"), str(file))

        def work(document: Document = document) -> None:
            blueprint = read_blueprint(document)
            inspect(blueprint)
            prove(blueprint)

        spent.append((median_ms(work, runs=5), file.name))
    worst, name = max(spent)
    words = f"all rules and properties of {len(spent)} samples"
    yield Row(f"{words}: the slowest ({name})", worst, bound="at most 100 ms")
    yield Row(f"{words}, one after the other", sum(one for one, _ in spent))


def _large() -> Iterator[Row]:
    for words, values in LARGE:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "large.json"
            file.write_text(json.dumps(values))
            command = [sys.executable, "-m", "smsl_studio", "check", str(file)]
            command += ["--rule", "R19", "--rule", "R30", "--format", "json"]
            said = subprocess.run(command, capture_output=True, check=False).stdout
            (found,) = json.loads(said)["files"]
            verdicts = ", ".join(one["verdict"] for one in found["properties"])
            count = found["properties"][0]["configurations"]
            spent = process_ms(partial(subprocess.run, command, capture_output=True), runs=3)
            work = f"{words}, {count or 0:.3g} configurations: {verdicts}"
            yield Row(work, spent, bound=BOUNDS.get(words, SOON))


def counter(states: int) -> dict[str, Any]:
    """An SB with its states in a row."""
    table: dict[str, dict[str, str]] = {f"S{n}": {} for n in range(states)}
    for n in range(states - 1):
        table[f"S{n}"]["go"], table[f"S{n + 1}"]["back"] = f"S{n + 1}", f"S{n}"
    return {"HEADER": {"NUM_FACTS": 1}, **table}


def line(subs: list[str]) -> dict[str, Any]:
    """A base that turns its sub-SBs on one after the other."""
    count = len(subs)
    names = [f"S{'1' * n}{'0' * (count - n)}" for n in range(count + 1)]
    table: dict[str, dict[str, str]] = {name: {} for name in names}
    for one, other in pairwise(names):
        table[one]["on"], table[other]["off"] = other, one
    return _base(subs, table)


def cube(subs: list[str]) -> dict[str, Any]:
    """A base that turns its sub-SBs on in any order."""
    table: dict[str, dict[str, str]] = {}
    for bits in product("01", repeat=len(subs)):
        edges = table["S" + "".join(bits)] = {}
        for n, bit in enumerate(bits):
            other = "".join((*bits[:n], "10"[int(bit)], *bits[n + 1 :]))
            edges[f"{'off' if bit == '1' else 'on'}{n}"] = f"S{other}"
    return _base(subs, table)


def _base(subs: list[str], table: dict[str, dict[str, str]]) -> dict[str, Any]:
    digits = {name: digit for digit, name in enumerate(subs)}
    count = len(subs)
    header = {"INITIAL": "S" + "0" * count, "ACTIVATING": "S" + "1" * count}
    return {"HEADER": {**header, "NUM_FACTS": count, "SUB_SBS": digits}, **table}


def _named(count: int) -> list[str]:
    return [f"SUB{n:02}" for n in range(count)]


def _chain() -> dict[str, Any]:
    names = _named(10)
    values = {"BASE": line(names), **{name: counter(8) for name in names}}
    for one, other in pairwise(names):
        values[other]["_operations"] = {"go": {"requires": {f"{one}/0": "7"}}}
    return values


def _levels() -> dict[str, Any]:
    values: dict[str, Any] = {"R": line([f"M{n}" for n in range(4)])}
    for n in range(4):
        leaves = [f"L{n}{m}" for m in range(4)]
        values[f"M{n}"] = line(leaves)
        values.update((leaf, counter(3)) for leaf in leaves)
    return values


def _facts() -> dict[str, Any]:
    chance = Random(5)
    values: dict[str, Any] = {}
    for n in range(40):
        near = range(max(0, n - 8), n)
        needs = {f"F{m:02}/0": "1" for m in chance.sample(near, min(n, chance.randint(0, 2)))}
        notes = {"_operations": {"do": {"requires": needs}}} if needs else {}
        values[f"F{n:02}"] = {"HEADER": {"NUM_FACTS": 1}, **notes, "S0": {"do": "S1"}, "S1": {}}
    return values


def _never_so(facts: dict[str, Any]) -> str:
    """Return that the last fact that requires one holds without it."""
    name = max(name for name, one in facts.items() if "_operations" in one)
    needed = min(facts[name]["_operations"]["do"]["requires"])
    return f"{name} = 1 and {needed} = 0"


def _asked(values: dict[str, Any], never: str, reachable: str) -> dict[str, Any]:
    properties = [{"name": "n", "never": never}, {"name": "r", "reachable": reachable}]
    return {"_properties": properties, **values}


FACTS = "40 facts that require each other"
BOUNDS = {FACTS: "at most 15,000 ms", f"{FACTS}, no run is shown": "at most 1,000 ms"}
LARGE = (
    (
        "64 subs of 8 states under one base",
        _asked(
            {"BASE": line(_named(64)), **{name: counter(8) for name in _named(64)}},
            "SUB03 in S3 and SUB07 in S2",
            f"BASE in S{'1' * 64}",
        ),
    ),
    ("3 levels of 4x4x3", _asked(_levels(), "L00 in S1 and L21 in S2", "R in S1111")),
    (
        "a cube of 12 subs of 8 states",
        _asked(
            {"BASE": cube(_named(12)), **{name: counter(8) for name in _named(12)}},
            "SUB03 in S3 and SUB07 in S2",
            f"BASE in S{'1' * 12}",
        ),
    ),
    (
        "requires in a chain over 10 subs",
        _asked(_chain(), "SUB03 in S3 and SUB04 in S2", f"BASE in S{'1' * 10}"),
    ),
    (
        FACTS,
        _asked(_facts(), " and ".join(f"F{n:02} = 1" for n in range(40)), "F20 = 1 and F39 = 1"),
    ),
    (
        f"{FACTS}, no run is shown",
        _asked(_facts(), _never_so(_facts()), "F20 = 1 and F39 = 1"),
    ),
)
