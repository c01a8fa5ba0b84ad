"""``generate explore``: a world is tried out, and what it permits is a blueprint."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import PlanningError, PluginError, UsageError, WorldError
from smsl_studio.front.attempts import bound_names
from smsl_studio.front.hosts import known_world
from smsl_studio.front.physics import (
    Explored,
    against,
    generate_explore,
    start_of_values,
)
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import blueprint_of, write_plugin

SWITCHES = """
def register(library):
    @library.world("switches", engine="table", settle=0.1, values=("0", "1"))
    def build(world, blueprint, seed):
        (world.sb,) = (branch.name for branch in blueprint)

    @library.arrange("switches")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("switch_{n}", fact="{n}", period=0.1)
    def switch(world, n: int):
        return world.fact(world.sb, n - 1)

    @library.operation("Op_{n}{to}", timeout=5.0)
    def turn(world, n: int, to: str):
        yield
        if n > 2 or (n == 2 and world.fact(world.sb, 0) == "0"):
            return False
        world.set_facts({(world.sb, n - 1): to})

    @library.operation("Op_reset", recovery=True)
    def reset(world):
        yield
        world.set_facts({(world.sb, 0): "0", (world.sb, 1): "0"})

    @library.operation("Op_break")
    def smash(world):
        yield
        raise RuntimeError("it broke")

    @library.operation("Op_lose")
    def lose(world):
        yield
        world.set_facts({(world.sb, 0): "q"})

    @library.operation("Op_idle")
    def idle(world):
        yield
"""
BOARD = {
    "BOARD": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
        "State_00": {"Op_11": "State_10", "Op_21": "State_01"},
        "State_10": {"Op_21": "State_11", "Op_10": "State_00"},
        "State_11": {"Op_20": "State_10", "Op_10": "State_01"},
        "State_01": {},
    }
}


@pytest.fixture
def paths(tmp_path: Path) -> tuple[Path, ...]:
    write_plugin(tmp_path, "switches", SWITCHES)
    return (tmp_path,)


def table_of(blueprint: Blueprint) -> dict[str, dict[str, str]]:
    (branch,) = blueprint
    return {state: dict(row) for state, row in branch.table.items()}


def test_what_the_world_permits_is_found(paths: tuple[Path, ...]) -> None:
    seen: list[tuple[int, int]] = []
    told = generate_explore(
        blueprint_of(BOARD), "switches", plugin_paths=paths, repeats=2,
        going=lambda done, found: seen.append((done, found)),
    )  # fmt: skip
    assert table_of(told.generated.blueprint) == {
        "State_00": {"Op_11": "State_10"},
        "State_10": {"Op_10": "State_00", "Op_21": "State_11"},
        "State_11": {"Op_10": "State_01", "Op_20": "State_10"},
        "State_01": {"Op_11": "State_11"},
    }
    assert (told.generated.goal_reached, told.bound) == (True, False)
    assert seen[-1] == (4, 4)
    origin = told.generated.blueprint.fields["_origin"]
    assert (origin["how"], origin["from"]) == ("explore", "switches")
    (branch,) = told.generated.blueprint
    assert (branch.initial, branch.activating) == ("State_00", "State_11")


def test_the_difference_names_what_is_missing_and_what_is_false(paths: tuple[Path, ...]) -> None:
    board = blueprint_of(BOARD)
    told = generate_explore(board, "switches", plugin_paths=paths)
    difference = against(told.generated.blueprint, board)
    assert difference.edges == 6
    assert difference.missing == ("BOARD/State_00/Op_21",)
    assert difference.false == ("BOARD/State_01/Op_11",)


def test_an_operation_that_changes_no_fact_is_not_missing_where_it_returns(
    paths: tuple[Path, ...],
) -> None:
    values = {**BOARD["BOARD"], "State_00": {"Op_idle": "State_00", "Op_break": "State_00"}}
    board = blueprint_of({"BOARD": values})
    told = generate_explore(board, "switches", plugin_paths=paths)
    difference = against(told.generated.blueprint, board, told.idle)
    assert difference.missing == ("BOARD/State_00/Op_break",)
    assert (("0", "0"), "Op_idle") in told.idle


def test_arguments_that_the_world_refuses_are_not_tried(tmp_path: Path) -> None:
    refusing = SWITCHES.replace(
        "        (world.sb,) =",
        "        from smsl_studio.errors import WorldError\n"
        "        for edge in (edge for branch in blueprint for edge in branch.edges()):\n"
        "            if 'lamp' in edge.address.operation:\n"
        "                raise WorldError(f'{edge.address} turns nothing')\n"
        "        (world.sb,) =",
    )
    write_plugin(tmp_path, "switches", refusing)
    facts = {"0": {"name": "lamp 1"}, "1": {"name": "lamp 2"}}
    named = blueprint_of({"BOARD": {**BOARD["BOARD"], "_facts": facts}})
    loaded = known_world("switches", (tmp_path,))
    assert loaded is not None
    assert "Op_1lamp 1" in bound_names(loaded, "switches", *named)
    told = generate_explore(named, "switches", plugin_paths=(tmp_path,))
    assert table_of(told.generated.blueprint)["State_00"] == {"Op_11": "State_10"}
    other = tmp_path / "other"
    write_plugin(other, "switches", refusing.replace("'lamp' in", "'' in"))
    with pytest.raises(WorldError, match="turns nothing"):
        generate_explore(named, "switches", plugin_paths=(other,))


def test_the_limit_keeps_what_was_reached(paths: tuple[Path, ...]) -> None:
    told = generate_explore(blueprint_of(BOARD), "switches", plugin_paths=paths, limit=2)
    assert told.bound
    assert table_of(told.generated.blueprint) == {
        "State_00": {"Op_11": "State_10"},
        "State_10": {"Op_10": "State_00"},
    }
    assert not told.generated.goal_reached


def test_an_exploration_that_was_broken_off_goes_on(
    paths: tuple[Path, ...], tmp_path: Path
) -> None:
    part = tmp_path / "found.json.part"
    board = blueprint_of(BOARD)

    class BrokenOffError(Exception):
        pass

    def until_two(done: int, _found: int) -> None:
        if done == 2:
            raise BrokenOffError

    with pytest.raises(BrokenOffError):
        generate_explore(board, "switches", plugin_paths=paths, part=part, going=until_two)
    kept = part.read_bytes()
    assert kept.count(b"\n") == 3
    whole = table_of(generate_explore(board, "switches", plugin_paths=paths).generated.blueprint)
    for cut in (0, 9):
        part.write_bytes(kept[: len(kept) - cut])
        told = generate_explore(board, "switches", plugin_paths=paths, part=part)
        assert table_of(told.generated.blueprint) == whole
        rows = [line for line in part.read_bytes().splitlines() if line.endswith(b"}}")]
        assert len(rows) == len(whole), "no state was tried twice"
    lying = kept.replace(b'"Op_11": ["1", "0"]', b'"Op_11": ["1", "1"]')
    part.write_bytes(lying)
    told = generate_explore(board, "switches", plugin_paths=paths, part=part)
    assert table_of(told.generated.blueprint)["State_00"] == {"Op_11": "State_11"}, "it is read"
    told = generate_explore(board, "switches", plugin_paths=paths, part=part, repeats=2)
    assert table_of(told.generated.blueprint) == whole, "another exploration begins anew"
    for other in (b'"Op_more": ["1", "0"]', b'"Op_11": ["q", "0"]'):
        part.write_bytes(kept.replace(b'"Op_11": ["1", "0"]', other))
        told = generate_explore(board, "switches", plugin_paths=paths, part=part)
        assert table_of(told.generated.blueprint) == whole, "what cannot be is tried anew"
    part.write_bytes(kept.splitlines()[0] + b"\n\n[]\n\xff\n" + b"[" * 9_000)
    told = generate_explore(board, "switches", plugin_paths=paths, part=part)
    assert table_of(told.generated.blueprint) == whole


@pytest.mark.parametrize("raw", [b"my notes\n", b"\n", b'{"SB": {}}'])
def test_a_file_of_somebody_else_stays_where_an_exploration_would_keep_its_part(
    paths: tuple[Path, ...], tmp_path: Path, raw: bytes
) -> None:
    part = tmp_path / "found.json.part"
    part.write_bytes(raw)
    with pytest.raises(UsageError, match="is not what an exploration has kept"):
        generate_explore(blueprint_of(BOARD), "switches", plugin_paths=paths, part=part)
    assert part.read_bytes() == raw


def test_operations_that_recover_are_not_tried(paths: tuple[Path, ...]) -> None:
    loaded = known_world("switches", paths)
    assert loaded is not None
    names = bound_names(loaded, "switches", blueprint_of(BOARD)["BOARD"])
    turns = ("Op_10", "Op_11", "Op_20", "Op_21", "Op_00", "Op_01")
    assert names == (*turns, "Op_break", "Op_lose", "Op_idle")
    hanoi = known_world("hanoi")
    assert hanoi is not None
    board = smsl.read(samples_dir() / "hanoi-2.json")
    found = bound_names(hanoi, "hanoi", board["SB1"])
    assert found == tuple(f"Op_{disk}{peg}" for disk in "12" for peg in "abc")


def test_what_cannot_be_explored_is_refused(paths: tuple[Path, ...]) -> None:
    with pytest.raises(UsageError, match="no operations of its own"):
        generate_explore(blueprint_of(BOARD), "table")
    with pytest.raises(WorldError, match="no world"):
        generate_explore(blueprint_of(BOARD), "moon", plugin_paths=paths)
    with pytest.raises(PlanningError, match="one State Branch"):
        generate_explore(smsl.read(samples_dir() / "hfsm.json"), "switches", plugin_paths=paths)


def test_an_unknown_mark_of_an_operation_is_a_fault() -> None:
    library = OperationLibrary("board")
    with pytest.raises(PluginError, match="no 'recover'"):
        library.operation("Op_reset", recover=True)
    with pytest.raises(PluginError, match="recovery"):
        library.operation("Op_reset", recovery="yes")  # type: ignore[arg-type]


def test_values_are_a_start_where_the_world_declares_them(paths: tuple[Path, ...]) -> None:
    for text in ("00", "0,0", "State_00"):
        start = start_of_values(text, "switches", paths)
        told = generate_explore(start, "switches", plugin_paths=paths)
        assert told.generated.operations == 6
        assert told.generated.goal_reached
    for wrong in ("", "02", "0,", "State_"):
        with pytest.raises(UsageError, match="is no start of the world switches"):
            start_of_values(wrong, "switches", paths)
    with pytest.raises(UsageError, match="does not declare"):
        start_of_values("00", "table")
    for world, values in (("hanoi", "aaa"), ("river", "0000"), ("chess", "0B1B")):
        assert start_of_values(values, world)["SB1"].num_facts in (2, 3, 4)


LATCH = """
def register(library):
    @library.world("latch", engine="table", settle=0.1, values=("0", "1"))
    def build(world, blueprint, seed):
        (world.sb,) = (branch.name for branch in blueprint)
        world.bad = seed % 4 == 1

    @library.arrange("latch")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("latch", fact="1", period=0.1)
    def latch(world):
        return world.fact(world.sb, 0)

    @library.operation("Op_close")
    def close(world):
        yield
        world.set_facts({(world.sb, 0): "j" if world.bad else "1"})
        return not world.bad

    @library.operation("Op_open")
    def open_it(world):
        yield
        world.set_facts({(world.sb, 0): "0"})
"""


def test_what_sometimes_fails_gets_its_rate_and_its_failure_state(tmp_path: Path) -> None:
    write_plugin(tmp_path, "latch", LATCH)
    door = blueprint_of(
        {
            "DOOR": {
                "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
                "_facts": {"0": {"name": "door"}},
                "State_0": {},
                "State_1": {},
            }
        }
    )
    part = tmp_path / "door.json.part"

    def explored(rates: bool) -> Explored:
        return generate_explore(
            door, "latch", plugin_paths=(tmp_path,), repeats=4, rates=rates, part=part
        )

    assert table_of(explored(rates=False).generated.blueprint) == {"State_0": {}}
    for again in (False, True):
        told = explored(rates=True)
        made = told.generated.blueprint
        assert told.rates == {"DOOR/State_0/Op_close": 3}, again
        assert table_of(made) == {
            "State_0": {"Op_close": "State_1"}, "State_1": {"Op_open": "State_0"}, "State_j": {},
        }  # fmt: skip
        branch = made["DOOR"]
        assert branch.cost("State_0", "Op_close") == 1.25
        assert branch.operation_note("State_0", "Op_close").risk == "medium"
        assert branch.operation_note("State_1", "Op_open").risk is None
        assert made.document.values["DOOR"]["_facts"]["0"] == {"name": "door", "failure": ["j"]}
    kept = part.read_bytes()
    assert kept.count(b"\n") == 3, "the second time nothing was tried"
    part.write_bytes(kept.replace(b'"Op_close": 3', b'"Op_close": 9'))
    assert explored(rates=True).rates == {"DOOR/State_0/Op_close": 3}, "it was tried anew"
