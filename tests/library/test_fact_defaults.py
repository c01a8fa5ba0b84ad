"""Default predicates of a plugin: they decide a fact where the blueprint writes no predicate."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.errors import PluginError
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.runlog.events import FactChanged, Measured
from tests.plugin_folder import write_plugin

PLUGIN = """
class Clamp:
    force = 0.5

def register(library):
    @library.world("clamp", engine="table", settle=0.1)
    def build(world, blueprint, seed): return Clamp()

    @library.arrange("clamp")
    def arrange(clamp, facts): clamp.force = 5.0 if facts[("SB", 0)] == "1" else 0.5

    @library.sensor("force_{n}", unit="N")
    def force(clamp, n: int): return clamp.force if clamp.force < 100 else None

    library.fact("clamped_{n}", "SB/{n}", {"0": "force_{n} < 1 N", "1": "force_{n} > 2000 mN"}, %r)

    @library.operation("Close")
    def close(clamp):
        clamp.force = %s
        yield
"""


def run(
    folder: Path,
    force: str,
    host: str = "local",
    otherwise: str = "",
    entry: dict[str, Any] | None = None,
) -> Any:
    write_plugin(folder, "clamp", PLUGIN % (otherwise, force))
    text: dict[str, Any] = {"SB": {"State_0": {"Close": "State_1"}, "State_1": {}}}
    if entry:
        text["SB"]["_facts"] = {"0": entry}
    file = folder / "clamp.json"
    file.write_text(json.dumps(text), encoding="utf-8")
    return front.run(front.read(file), "clamp", plugin_paths=[folder], host=host)


def values(done: front.Run) -> list[str | None]:
    return [one.value for one in done.events if isinstance(one, FactChanged)]


@pytest.mark.parametrize("host", ["local", "process"])
def test_the_plugin_decides_and_the_log_has_no_measures(tmp_path: Path, host: str) -> None:
    done = run(tmp_path, "4.0", host)
    assert (done.reason, values(done)) == ("goal_reached", ["0", "1"])
    assert not any(isinstance(one, Measured) for one in done.events)


@pytest.mark.parametrize("host", ["local", "process"])
def test_a_blueprint_decides_otherwise_from_the_same_measure(tmp_path: Path, host: str) -> None:
    predicate = {"0": "force_1 < 4.5 N", "1": "force_1 > 5 N"}
    entry = {"sources": {"force_1": "N"}, "predicate": predicate}
    done = run(tmp_path, "4.0", host, entry=entry)
    assert (done.reason, values(done)) == ("held", ["0"])
    assert any(isinstance(one, Measured) for one in done.events)


@pytest.mark.parametrize(
    ("force", "otherwise", "told", "reason"),
    [
        ("1.5", "", None, "no valid reading"),
        ("1.5", "x", "x", ""),
        ("200.0", "x", None, "no valid reading"),
        ("-1e999", "x", None, "no finite number"),
        ("'much'", "", None, "TypeError"),
    ],
)
def test_what_no_condition_covers(
    tmp_path: Path, force: str, otherwise: str, told: str | None, reason: str
) -> None:
    done = run(tmp_path, force, otherwise=otherwise)
    last = [one for one in done.events if isinstance(one, FactChanged)][-1]
    assert (done.reason, last.value) == ("held", told)
    assert reason in last.reason


def library() -> OperationLibrary:
    made = OperationLibrary("x")
    made.sensor("force_{n}", unit="N")(lambda world, n: 1.0)
    made.sensor("seen_{n}", "SB/{n}")(lambda world, n: "1")
    return made


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("f_{n}", "SB/{n}", {"1": "farce_{n} < 1 N"}), "no sensor measures 'farce_"),
        (("f_{n}", "SB/{n}", {"1": "seen_{n} < 1 N"}), "no sensor measures 'seen_"),
        (("f_{n}", "SB/{n}", {"1": "force_{n} < 1 mm"}), "compared with a measure in N"),
        (("f_{n}", "SB/{n}", {"1": "force_{n} > 1 N for 1 s"}), "has a for"),
        (("f_{n}", "SB/{n}", {"1": "age(force_{n}) > 1 s"}), "has an age"),
        (("f_{n}", "SB/{n}", {"1": "force_{n} <"}), "a number is expected"),
        (("f_{n}", "SB/{n}", {"1": "force_{n} < 1 N" + " " * 1_000_000}), "too long"),
        (("f_{n}", "SB/{n}", {}), "predicate is no map"),
        (("f_{n}", "SB/{n}", {"1": 5}), "is no text"),
        (("f_{n}", "SB/{m}", {"1": "force_{n} < 1 N"}), "do not name the same parameters"),
        (("f_{n}", "SB/{n}", {"1": "force_{n} < 1 N"}, "\n"), "which no name may have"),
    ],
)
def test_predicates_that_cannot_decide_are_refused(given: tuple[Any, ...], words: str) -> None:
    with pytest.raises(PluginError) as refused:
        library().fact(*given)
    assert words in str(refused.value)


def test_terms_are_those_of_a_sensor() -> None:
    made = library()
    made.fact("f_{n}", "SB/{n}", {"1": "force_{n} < 1 N"}, period=0.5, words={"1": "low"})
    assert (made.sensors[-1].period, made.sensors[-1].words) == (0.5, {"1": "low"})
    with pytest.raises(PluginError, match="have no 'unit'"):
        made.fact("g_{n}", "SB/{n}", {"1": "force_{n} < 1 N"}, unit="N")
