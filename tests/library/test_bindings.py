"""The code of an edge: the order of the bindings, and bindings that do not fit."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import Place, PluginError
from smsl_studio.front.inputs import read
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside, read_bindings
from smsl_studio.library.bound import Bindings
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover
from tests.plugin_folder import blueprint_of, write_plugin

RULES = 'facts = [{name = "a", values = ["0", "1"]}]\nstart = ["0"]\n[[rule]]\noperation = "x"\n'
PLUGIN = """
def register(library):
    @library.world("w", engine="table")
    def build(world, blueprint, seed): ...

    @library.sensor("eye_{n}", fact="{n}", period=0.5, max_age=2.0)
    def eye(world, n: int): ...

    @library.sensor("ear")
    def ear(world): ...

    @library.sensor("sub_{n}", fact="SB2/{n}")
    def sub(world, n: int): ...

    @library.operation("Op_{disk}{peg}")
    def move(world, disk: int, peg: str):
        yield

    @library.operation("Op_{anything}")
    def anything(world, anything: str):
        yield

    @library.operation("Op_plain", stop="abort", timeout=3.0, resumes=False)
    def plain(world):
        yield

    @library.operation("Push_{n}", touches=("{n}", "SB2/1"))
    def push(world, n: int):
        yield

    @library.operation()
    def by_hand(world, speed: float = 1.0, careful: bool = False, **more):
        yield

    @library.operation()
    def strict(world, count: int):
        yield
"""

OTHER = """
def register(library):
    @library.world("other", engine="table")
    def build(world, blueprint, seed): ...

    @library.operation("Op_{disk}{peg}")
    def elsewhere(world, disk: int, peg: str):
        yield
"""

GENERAL = """
def register(library):
    @library.operation("Wait_{seconds}")
    def wait(world, seconds: float):
        yield
"""

A, B = "State_00", "State_10"


def _values(**notes: Any) -> dict[str, Any]:
    names = ("Op_1b", "Op_xy", "Op_plain", "Wait_2.5", "Else")
    return {
        "SB1": {
            "HEADER": {"SUB_SBS": {"SB2": 1}},
            **notes,
            A: dict.fromkeys(names, B),
            B: {"Op_1b": A},
        },
        "SB2": {"HEADER": {}, "State_0": {"Op_1a": "State_1"}, "State_1": {}},
    }


@pytest.fixture
def loaded(tmp_path: Path) -> Loaded:
    write_plugin(tmp_path, "p", PLUGIN)
    write_plugin(tmp_path, "other", OTHER)
    write_plugin(tmp_path, "general", GENERAL)
    return discover([tmp_path])


def _bind(loaded: Loaded, file: BindingsFile | None = None, **notes: Any) -> Bindings:
    return bind(blueprint_of(_values(**notes)), loaded, "w", file)


def _name(bindings: Bindings, state: str, operation: str) -> tuple[str, Any, bool] | None:
    bound = bindings.operations.get(Address("SB1", state, operation))
    return None if bound is None else (bound.name, dict(bound.arguments), bound.exact)


def _file(tmp_path: Path, text: str) -> BindingsFile:
    path = tmp_path / "b.toml"
    path.write_text(text, "utf-8")
    return read_bindings(path)


def test_names_find_their_functions_and_typed_arguments(loaded: Loaded) -> None:
    bindings = _bind(loaded)
    assert _name(bindings, A, "Op_1b") == ("p.move", {"disk": 1, "peg": "b"}, False)
    assert _name(bindings, A, "Op_xy") == ("p.anything", {"anything": "xy"}, False)
    assert _name(bindings, A, "Op_plain") == ("p.plain", {}, False)
    assert _name(bindings, A, "Wait_2.5") == ("general.wait", {"seconds": 2.5}, False)
    assert _name(bindings, A, "Else") is None
    assert bindings.faults == ()


def test_stop_and_timeout_come_from_the_function_and_the_note(loaded: Loaded) -> None:
    plain = Address("SB1", A, "Op_plain")
    bound = _bind(loaded).operations[plain]
    assert (bound.stop, bound.timeout) == ("abort", 3.0)
    noted = _bind(loaded, _operations={"Op_plain": {"stop": "finish", "timeout": 9.0}})
    bound = noted.operations[plain]
    assert (bound.stop, bound.timeout) == ("finish", 9.0)


def _pushed(loaded: Loaded, *names: str, **notes: Any) -> Bindings:
    values = _values(**notes)
    values["SB1"][A] |= dict.fromkeys(names, B)
    return bind(blueprint_of(values), loaded, "w", None)


def test_what_a_pause_and_a_cancel_do_comes_from_the_function_and_the_note(loaded: Loaded) -> None:
    plain, push = Address("SB1", A, "Op_plain"), Address("SB1", A, "Push_1")
    found = _pushed(loaded, "Push_1").operations
    assert (found[plain].resumes, found[plain].touches) == (False, ())
    assert (found[push].resumes, found[push].touches) == (True, (("SB1", 0), ("SB2", 0)))
    note = {"Op_plain": {"resumes": True, "touches": [0]}}
    bound = _pushed(loaded, _operations=note).operations[plain]
    assert (bound.resumes, bound.touches) == (True, (("SB1", 0),))


def test_touching_what_is_no_fact_is_a_fault(loaded: Loaded) -> None:
    bindings = _pushed(loaded, "Push_9")
    assert Address("SB1", A, "Push_9") not in bindings.operations
    assert "p.push touches 9, which is no fact" in [fault.sentence for fault in bindings.faults]


def test_exact_comes_before_name_before_pattern(loaded: Loaded, tmp_path: Path) -> None:
    def note(speed: float) -> dict[str, Any]:
        return {"binding": {"function": "p.by_hand", "arguments": {"speed": speed}}}

    notes = {"Op_1b": note(1), f"{A}/Op_1b": note(2)}
    by_note = _bind(loaded, _operations=notes)
    assert _name(by_note, A, "Op_1b") == ("p.by_hand", {"speed": 2.0}, True)
    assert _name(by_note, B, "Op_1b") == ("p.by_hand", {"speed": 1.0}, False)
    file = _file(
        tmp_path,
        "[world.w.operations]\n"
        f'"{A}/Op_1b" = {{function="p.by_hand", speed=3}}\n'
        '"Op_1b" = {function="p.by_hand", speed=4}\n'
        '"Else" = {function="p.by_hand", mood="calm"}\n'
        "[world.other.operations]\n"
        '"Op_xy" = {function="nobody.asks"}\n',
    )
    both = _bind(loaded, file, _operations=notes)
    by_name = _file(tmp_path, '[world.w.operations]\n"Op_1b" = {function="p.by_hand", speed=5}\n')
    mixed = _bind(loaded, by_name, _operations=notes)
    assert _name(mixed, A, "Op_1b") == ("p.by_hand", {"speed": 2.0}, True)
    assert _name(both, A, "Op_1b") == ("p.by_hand", {"speed": 3.0}, True)
    assert _name(both, B, "Op_1b") == ("p.by_hand", {"speed": 4.0}, False)
    assert _name(both, A, "Else") == ("p.by_hand", {"mood": "calm"}, False)
    assert both.faults == ()


def test_names_with_slashes_are_written_as_in_addresses(loaded: Loaded, tmp_path: Path) -> None:
    def note(function: str) -> dict[str, Any]:
        return {"binding": {"function": function}}

    values = {
        "A/B": {
            "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1"},
            "_operations": {"go~1on": note("p.by_hand"), "State_1/a~0b": note("p.plain")},
            "State_0": {"go/on": "State_1", "by/file": "State_1"},
            "State_1": {"a~b": "State_0"},
        }
    }
    file = _file(
        tmp_path,
        '[world.w.operations]\n"by~1file" = {function="p.by_hand"}\n'
        '[world.w.facts]\n"A~1B/0" = "ear"\n',
    )
    bindings = bind(blueprint_of(values), loaded, "w", file)
    assert bindings.faults == ()
    assert {str(edge): bound.name for edge, bound in bindings.operations.items()} == {
        "A~1B/State_0/go~1on": "p.by_hand",
        "A~1B/State_0/by~1file": "p.by_hand",
        "A~1B/State_1/a~0b": "p.plain",
    }
    assert [sensor.name for sensor in bindings.sensors] == ["ear"]


def test_a_binding_of_an_imported_branch_is_told_with_its_own_file(
    loaded: Loaded, tmp_path: Path
) -> None:
    (tmp_path / "below.json").write_text(blueprint_of(_values(_operations=_BAD)).document.text)
    (tmp_path / "above.json").write_text('{"_imports": ["below.json"]}')
    bindings = bind(read(tmp_path / "above.json"), loaded, "w")
    places = {fault.place.file for fault in bindings.faults if fault.place}
    assert places == {str(tmp_path / "below.json")}


_BAD = {"Else": {"binding": {"function": "p.nothing"}}}


@pytest.mark.parametrize(
    ("binding", "words"),
    [
        ({"function": "p.strikt"}, "no function 'p.strikt'. Did you mean p.strict?"),
        ({"function": "other.elsewhere"}, "no function 'other.elsewhere'"),
        ({"function": "p.strict"}, "'count' is missing"),
        ({"function": "p.strict", "count": "1"}, "count is '1', not a whole number"),
        ({"function": "p.strict", "count": True}, "count is True, not a whole number"),
        ({"function": "p.strict", "count": 1, "cuont": 2}, "no parameter 'cuont'"),
    ],
)
def test_a_binding_that_does_not_fit_is_a_fault_with_its_place(
    loaded: Loaded, binding: dict[str, Any], words: str
) -> None:
    arguments = {k: v for k, v in binding.items() if k != "function"}
    note = {"binding": {"function": binding["function"], "arguments": arguments}}
    bindings = _bind(loaded, _operations={f"{A}/Op_1b": note})
    assert _name(bindings, A, "Op_1b") is None
    (fault,) = bindings.faults
    assert words in fault.sentence
    assert fault.place is not None
    assert fault.place.line == 9


def test_a_bindings_file_belongs_to_the_project_of_its_blueprint(tmp_path: Path) -> None:
    blueprint, beside = tmp_path / "inner" / "b.json", tmp_path / "inner" / "b.toml"
    blueprint.parent.mkdir()
    other, secret = tmp_path / "other.toml", tmp_path / "secret"
    os.mkfifo(blueprint.with_name("pipe.toml"))
    other.write_text('[world.w.facts]\n"SB1/0" = "eye"\n')
    secret.write_text("root:$6$topsecret:19000:0")
    cases: tuple[tuple[Callable[[], None], str], ...] = (
        (lambda: beside.symlink_to(other), "the bindings file leads out of the project"),
        (lambda: beside.symlink_to(secret), "the bindings file leads out of the project"),
        (lambda: beside.symlink_to("/proc/kmsg"), "the bindings file leads out of the project"),
        (lambda: beside.symlink_to(blueprint), "the bindings file leads to a file of another kind"),
        (lambda: beside.symlink_to("gone.toml"), "cannot be read: No such file"),
        (lambda: os.mkfifo(beside), "cannot be read: it is no ordinary file"),
        (lambda: beside.symlink_to("pipe.toml"), "cannot be read: it is no ordinary file"),
    )
    for make, words in cases:
        make()
        with pytest.raises(PluginError, match=words) as caught:
            bindings_beside(str(blueprint))
        assert "topsecret" not in str(caught.value)
        assert caught.value.place == Place(str(beside), 1, 1)
        beside.unlink()
    (tmp_path / "smsl.toml").touch()
    beside.symlink_to(other)
    assert bindings_beside(str(blueprint)).of("w").facts == {"SB1/0": "eye"}


def test_a_bindings_file_that_names_nothing_is_a_fault(loaded: Loaded, tmp_path: Path) -> None:
    file = _file(
        tmp_path,
        '[world.w.operations]\n"Op_1q" = {function="p.by_hand"}\n'
        '[world.w.facts]\n"SB1/1" = "ear"\n"SB1/0" = "nose"\n',
    )
    faults = {fault.subject: fault for fault in _bind(loaded, file).faults}
    assert faults.keys() == {"'Op_1q'", "'SB1/1'", "fact SB1/0"}
    assert {fault.place.line for fault in faults.values() if fault.place} == {2, 4, 5}


def test_facts_find_their_sensors(loaded: Loaded, tmp_path: Path) -> None:
    plain = {(s.branch, s.digit): s for s in _bind(loaded).sensors}
    assert {key: sensor.name for key, sensor in plain.items()} == {
        ("SB1", 0): "eye_1",
        ("SB2", 0): "sub_1",
    }
    eye = plain["SB1", 0]
    assert (eye.period, eye.max_age, dict(eye.arguments)) == (0.5, 2.0, {"n": 1})
    note = {"0": {"sensors": ["ear", "eye_2"], "aggregation": "priority", "max_age": 0.7}}
    noted = [s for s in _bind(loaded, _facts=note).sensors if s.branch == "SB1"]
    assert [(s.name, s.aggregation, s.max_age) for s in noted] == [
        ("ear", "priority", 0.7),
        ("eye_2", "priority", 0.7),
    ]
    file = _file(tmp_path, '[world.w.facts]\n"SB1/0" = "ear"\n')
    assert [s.name for s in _bind(loaded, file, _facts=note).sensors] == ["ear", "sub_1"]


def test_the_file_beside_a_blueprint_is_found(tmp_path: Path) -> None:
    (tmp_path / "b.toml").write_text('[world.w.operations]\nOp = {function="p.f", x=1}\n')
    table = bindings_beside(str(tmp_path / "b.json")).of("w")
    assert table.operations["Op"].arguments == {"x": 1}
    assert not bindings_beside(str(tmp_path / "c.json")).worlds
    assert not bindings_beside("<stdin>").worlds


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("[world.w.operations]\nOp = {function=\n", 2),
        ('\n[world.w.operations]\nOp = {functoin="p.f"}\n', 3),
        ('[world.w.operations]\nOp = "p.f"\n', 2),
        ("[worlds.w]\n", 1),
        ('[world.w.operations]\nOp = {function="p.f"}\n[world.w.fact]\na = "b"\n', 3),
    ],
)
def test_a_broken_bindings_file_names_its_line(tmp_path: Path, text: str, line: int) -> None:
    with pytest.raises(PluginError) as caught:
        _file(tmp_path, text)
    assert caught.value.place is not None
    assert caught.value.place.line == line


def test_rules_beside_a_blueprint_bind_nothing(tmp_path: Path) -> None:
    (tmp_path / "hanoi.toml").write_text(RULES)
    assert not bindings_beside(str(tmp_path / "hanoi.json")).worlds
    (tmp_path / "hanoi.toml").write_text(f"{RULES}[world.hanoi.operations]\n")
    with pytest.raises(PluginError, match="Extra inputs"):
        bindings_beside(str(tmp_path / "hanoi.json"))
