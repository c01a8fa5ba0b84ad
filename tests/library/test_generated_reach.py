"""What generated code may not say: it is found in the text, with its line, and nothing runs."""

from __future__ import annotations

import gc
import sys
from contextlib import suppress
from pathlib import Path
from textwrap import indent
from types import SimpleNamespace
from typing import Any

import pytest

from smsl_studio.errors import PluginError
from smsl_studio.library.generated_functions import digest_of, is_skeleton, register_generated
from smsl_studio.library.generated_reach import code_faults, parsed
from smsl_studio.library.generated_watch import Steps, watched
from smsl_studio.library.manifest import GeneratedFunction
from smsl_studio.library.operation_library import OperationLibrary
from tests.cases import case

GOOD = '''
_origin = {"stage": "rmm"}


def near(a: float, b: float = 0.1) -> bool:
    return abs(a - b) < 1e-3


def op_fix(world):
    """Fix it."""
    for _ in range(3):
        yield
    try:
        if (yield from do(world, "Op_1b")) is False or not near(math.pi):
            return False
    except ValueError as error:
        raise RuntimeError(f"it does not hold: {error}") from None
    counts = [0] * 3
    counts[0] += 1
    counts[1:] = [2, 3]
    told = [one.name for one in sorted(world.disks, key=lambda disk: disk.size) if one]
    return f"{len(told)} rings"
'''
BODIES = {
    "import os": "it imports os",
    "from os import path": "it imports os",
    "open('/etc/passwd')": "it asks for open",
    "eval('1')": "it asks for eval",
    "exec('1')": "it asks for exec",
    "getattr(world, 'x')": "it asks for getattr",
    "vars(world)": "it asks for vars",
    "type(world)": "it asks for type",
    "__import__('os')": "it asks for __import__",
    "world.__class__": "it reads __class__",
    "world._client": "it reads _client",
    "__builtins__": "it reads __builtins__",
    "do(world, 'Op_1b').gi_frame.f_globals": "which leads out of it",
    "'{0.__class__}'.format(world)": "it reads format",
    "class A: pass": "it makes a class",
    "global x": "it changes what is outside",
    "with world: pass": "it enters a context",
    "async def f(): await world": "it waits for something else",
    "del world": "Delete is not for generated code",
    "def g(x=world): yield": "a default that is no plain value",
    "f(**{'a': 1}, _b=2)": "it reads _b",
    "print(world)": "it asks for print",
    "breakpoint()": "it asks for breakpoint",
    "world.distance = lambda disk, peg: 0.0": "it sets distance of something that is not its own",
    "world.arm.height += 1": "it sets height",
    "world.height: int = 1": "it sets height",
    "for world.height in range(3): yield": "it sets height",
    "[0 for world.height in range(3)]": "it sets height",
    "(a, *world.height) = [1, 2]": "it sets height",
    "world.facts['a'] = 1": "it sets an item of something that is not its own",
    "found = world.facts; found['a'] = 1": "it sets an item",
    "found = [world.facts]; found[0]['a'] = 1": "it sets an item",
    "found = {}; (found := world.facts); found['a'] = 1": "it sets an item",
    "setattr(world, 'a', 1)": "it asks for setattr",
    "match world:\n        case _: pass": "is not for generated code",
}


def test_code_that_asks_its_world_alone_is_good() -> None:
    assert list(code_faults(GOOD)) == []


def test_what_leads_out_of_the_world_is_told_with_its_line() -> None:
    for body, words in BODIES.items():
        with case("code", body):
            text = f"def op_fix(world):\n    yield\n    {body}\n"
            found = list(code_faults(text))
            assert words in found[0].sentence
            assert found[0].line == 3
            with pytest.raises(PluginError, match=r"fix\.py:3:1: "):
                parsed(text, "fix.py")


def test_nothing_stands_outside_of_functions() -> None:
    for text, words in {
        "x = 1\n": "outside of its functions",
        "[print(1)]\n": "outside of its functions",
        "_origin = world\n": "outside of its functions",
        "@do\ndef f(world): yield\n": "decorator",
        "def f(:\n": "no Python",
        "(" * 10_000: "no Python",
        "x = 1\n" * 10_000: "more than 20,000 characters",
    }.items():
        with case("text", text[:40]):
            assert words in next(code_faults(text)).sentence


BAD = {
    "def op_fix(world):\n    yield\n    break\n": (3, "'break' outside loop"),
    "def op_fix(world):\n    yield [(yield) for one in world.all]\n": (2, "'yield' inside list"),
    "def near(a, a): return a\ndef op_fix(world):\n    yield\n": (1, "duplicate argument 'a'"),
    f"\ndef op_fix(world):\n    yield\n    return {'-' * 2_500}1\n": (2, "no Python"),
    "def op_fix(world):\n    return 1\n": (1, "op_fix has no yield"),
    "def op_fix(world):\n    def inner(): yield\n": (1, "op_fix has no yield"),
    "\ndef op_fix(world, more):\n    yield\n": (2, "op_fix takes more or less than the world"),
    "def op_other(world):\n    yield\n": (1, "it has no function op_fix"),
}


def test_code_that_cannot_be_compiled_or_is_no_motion_is_told_with_its_line() -> None:
    for text, (line, words) in BAD.items():
        with case("text", text[:60]):
            (fault,) = code_faults(text, "op_fix")
            assert (fault.line, words in fault.sentence) == (line, True), fault
    assert list(code_faults(GOOD, "op_fix")) == []


def test_a_finally_that_grows_with_each_level_is_not_compiled() -> None:
    """Python writes a finally once for each way into it: eighteen levels are a quarter of a
    million copies."""
    inner = "if world.a: return\n" * 2
    deep = "yield\n"
    for _ in range(18):
        deep = f"try:\n    yield\nfinally:\n{indent(deep, '    ')}"
    for body in (deep, f"try:\n    yield\nfinally:\n{indent(inner, '    ')}"):
        text = f"def op_fix(world):\n{indent(body, '    ')}"
        assert "its finally tries or leaves" in next(code_faults(text)).sentence


def test_a_file_that_cannot_be_loaded_keeps_no_other_away() -> None:
    good = "def op_fix(world):\n    yield\n"
    codes = {"good.py": good, "bad.py": next(iter(BAD)), "also.py": good}
    functions = tuple(
        GeneratedFunction(operation=f"LEG/{name}", file=name, function="op_fix") for name in codes
    )
    sources: Any = SimpleNamespace(
        folder=Path("rmm"), modules={name: code.encode() for name, code in codes.items()}
    )
    library = OperationLibrary("rmm_leg")
    register_generated(library, functions, sources)
    first, bad, last = library.operations
    for one in (first, last):
        assert list(one.function(None, operations=None)) == [None]
    assert first.code == digest_of("LEG/good.py", good.encode())
    assert bad.code != digest_of("LEG/bad.py", codes["bad.py"].encode()), "no trial counts for it"
    with pytest.raises(PluginError, match=r"bad\.py:3:1: .*'break' outside loop"):
        next(bad.function(None, operations=None))


def test_code_that_does_not_end_is_told_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Python would print a traceback when it forgets the code."""
    printed: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", printed.append)

    still = [True]

    def endless() -> Steps:
        while still:
            with suppress(GeneratorExit):
                yield

    steps = watched(endless)
    next(steps)
    with pytest.raises(RuntimeError, match=r"^the code goes on where it is told to end$"):
        steps.close()
    del steps
    gc.collect()
    assert printed == []
    still.clear()  # the end of the tests forgets it, too


def test_a_skeleton_is_known_by_its_last_line() -> None:
    unwritten = 'def f(world):\n    yield\n    raise NotImplementedError("nobody")\n'
    assert is_skeleton(parsed(unwritten, "f.py"))
    assert not is_skeleton(parsed(GOOD, "f.py"))
