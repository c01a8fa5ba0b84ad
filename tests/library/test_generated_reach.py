"""What generated code may not say: it is found in the text, with its line, and nothing runs."""

from __future__ import annotations

import pytest

from smsl_studio.errors import PluginError
from smsl_studio.library.generated_functions import is_skeleton
from smsl_studio.library.generated_reach import code_faults, parsed
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


def test_a_skeleton_is_known_by_its_last_line() -> None:
    unwritten = 'def f(world):\n    yield\n    raise NotImplementedError("nobody")\n'
    assert is_skeleton(parsed(unwritten, "f.py"))
    assert not is_skeleton(parsed(GOOD, "f.py"))
