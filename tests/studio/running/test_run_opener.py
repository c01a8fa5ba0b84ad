"""A run of the window under a trust policy: each refusal has its code, and stands in the log."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

import smsl_studio as smsl
from smsl_studio.errors import RunRefused, StudioError
from smsl_studio.front.hosts import make_ready
from smsl_studio.front.script.lines import script_of
from smsl_studio.home import user_folder
from smsl_studio.host.child import Recipe
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.spare import Spare
from smsl_studio.host.started_child import Child
from smsl_studio.library.permission import allow
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.studio.running.run_choice import RunChoice
from smsl_studio.studio.running.run_opener import RunOpener
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.runner import FASTEST
from tests.approval import DOOR, PASSPHRASE, make_keys_cheap, written_policy
from tests.cli.test_refusals import AT_PLAY
from tests.plugin_folder import LAMP, LAMP_PLUGIN, found_plugin, write_allowed

WORDS = PASSPHRASE.encode()
BROKEN = LAMP_PLUGIN.replace("world.set_facts(facts)", "pass").replace(
    'return world.fact("LAMP", n - 1)', "return None"
)


class Bench:
    """A blueprint with a policy, and a window's run without a window."""

    def __init__(self, folder: Path, qtbot: QtBot) -> None:
        self.file, self.qtbot = folder / "door.json", qtbot
        self.file.write_text(json.dumps(DOOR), "utf-8")
        self.policy = Path(written_policy(folder, ""))
        self.recordings = folder / "recordings"
        self.world = "table"
        self.spare: Spare | None = None
        smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
        self.blueprint = smsl.read(self.file)

    def approve(self, **more: object) -> None:
        request = smsl.ApprovalRequest(smsl.read(self.file), "ada", WORDS)
        smsl.approve(replace(request, **more))  # type: ignore[arg-type]

    def lamp(self, code: str = LAMP_PLUGIN, signed: bool = True) -> None:
        """Draw a lamp, and approve it with the code of its world."""
        values = {"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}
        self.file.write_text(json.dumps(values), "utf-8")
        self.world, self.blueprint = "lamp", smsl.read(self.file)
        write_allowed(user_folder(), "lamp", code)
        found = smsl.inspect(self.blueprint, world="lamp")
        known = [one for one in found if one.severity.value == "W"]
        texts = tuple(dict.fromkeys(f"{one.rule}@{one.address}=it is known" for one in known))
        self.approve(worlds=("lamp",) if signed else (), dispositions=texts)

    def play(self) -> tuple[list[str], RunSession]:
        """Begin a run, wait for its end, and return the codes of its refusals."""
        run = RunSession()
        run.recordings, run.spare = self.recordings, self.spare
        refused: list[StudioError] = []
        events: list[Event] = []
        run.refused.connect(refused.append)
        run.events_told.connect(events.extend)
        run.begin(self.blueprint, RunChoice(self.world, policy=self.policy), FASTEST,
                  loaded=describe())  # fmt: skip
        self.qtbot.waitUntil(
            lambda: bool(refused) or bool(events and isinstance(events[-1], RunFinished)),
            timeout=60_000,
        )
        run.close()
        if refused:
            assert isinstance(refused[0], RunRefused), refused
            return [code for code, _ in refused[0].refusals], run
        end = events[-1]
        assert isinstance(end, RunFinished)
        return [one["code"] for one in end.refusals] or [end.reason], run


class WatchedSpare(Spare):
    """Remembers which child it has handed over."""

    def __init__(self) -> None:
        super().__init__()
        self.handed: list[Child | None] = []

    def take(self, recipe: Recipe) -> Child | None:
        child = super().take(recipe)
        self.handed.append(child)
        return child


def logged(run: RunSession) -> list[str]:
    """The codes that the log of a run has."""
    assert run.record is not None
    assert smsl.verify(run.record).doubt is None
    end = json.loads(run.record.read_bytes().splitlines()[-2])
    assert end["event"] == "run_finished"
    return [one["code"] for one in end.get("refusals", ())]


@pytest.fixture
def bench(tmp_path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> Bench:
    make_keys_cheap(monkeypatch)
    return Bench(tmp_path, qtbot)


def code_missing(bench: Bench) -> None:
    bench.lamp(signed=False)


def code_changed(bench: Bench) -> None:
    bench.lamp()
    code = user_folder() / "plugins" / "lamp" / "plugin.py"
    code.write_text(code.read_text() + "\n# another version\n")
    allow(found_plugin("lamp"))


def start_unconfirmed(bench: Bench) -> None:
    bench.lamp(BROKEN)


def sensor_missing(bench: Bench) -> None:
    bench.approve(conditions=("sensor DOOR/0 at 1000000 Hz",))


def log_unwritable(bench: Bench) -> None:
    bench.approve()
    bench.recordings.write_text("a file, and no folder")


def file_changed(bench: Bench) -> None:
    bench.approve()
    bench.file.write_text(bench.file.read_text() + "\n")


WAYS: tuple[Callable[[Bench], None], ...] = (
    code_missing,
    code_changed,
    start_unconfirmed,
    sensor_missing,
    log_unwritable,
    file_changed,
)


def test_every_code_of_a_run_in_the_window_has_its_way() -> None:
    assert {way.__name__ for way in WAYS} == AT_PLAY


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
def test_a_run_is_refused_with_its_code_and_the_log_has_it(
    way: Callable[[Bench], None], bench: Bench
) -> None:
    way(bench)
    codes, run = bench.play()
    assert way.__name__ in codes
    if way is log_unwritable:
        assert run.record is None
    else:
        assert logged(run) == codes


def test_a_run_whose_policy_is_met_starts_and_its_log_says_who_has_signed(bench: Bench) -> None:
    assert bench.play()[0] == ["no_record"]
    bench.approve(conditions=("supervisor present", "world = table"))
    codes, run = bench.play()
    assert codes == ["goal_reached"]
    assert run.record is not None
    header = json.loads(run.record.read_bytes().splitlines()[0])
    assert header["policy"]["verdict"] == "approved"
    assert header["policy"]["met"] == ["supervisor present", "world = table"]
    assert header["policy"]["signers"][0]["person"] == "Ada Lovelace"


def test_who_sits_at_the_window_supervises_also_what_a_script_begins(bench: Bench) -> None:
    bench.approve(conditions=("supervisor present",))
    script = script_of(b'{"at": 9, "do": "pause"}', "script.jsonl", bench.blueprint)
    choice = RunChoice("table", policy=bench.policy, script=script)
    opener = RunOpener(choice.request(bench.blueprint), None, None, "M. Chen", None)
    opener.dispatcher().close()


def test_no_level_of_the_window_takes_from_people_what_was_signed(bench: Bench) -> None:
    bench.approve()
    choice = RunChoice("table", policy=bench.policy, levels={"supervision": "automatic"})
    opener = RunOpener(choice.request(bench.blueprint), None, None, "M. Chen", None)
    with pytest.raises(RunRefused, match="supervision is automatic and not shared"):
        opener.dispatcher()


def test_a_child_that_was_made_ready_before_the_check_is_not_used(bench: Bench) -> None:
    """The spare has loaded the code already, and nobody has hashed what it has loaded."""
    bench.lamp()
    spare = bench.spare = WatchedSpare()
    try:
        make_ready(spare, bench.blueprint, "lamp", 0, describe())
        assert spare.pid is not None
        assert bench.play()[0] == ["goal_reached"]
        assert spare.handed == [None]
    finally:
        spare.close()


def test_a_policy_that_is_gone_refuses_the_run(bench: Bench) -> None:
    bench.approve()
    bench.policy.unlink()
    run = RunSession()
    refused: list[StudioError] = []
    run.refused.connect(refused.append)
    run.begin(bench.blueprint, RunChoice("table", policy=bench.policy), FASTEST)
    bench.qtbot.waitUntil(lambda: bool(refused))
    assert "policy.toml" in str(refused[0])
    run.close()
