"""``nodes``: a site is made whose keys only the user can read, and its programs run and end."""

from __future__ import annotations

import json
import os
import signal
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.errors import PluginError
from smsl_studio.front.sites.node_programs import open_nodes
from smsl_studio.front.sites.site_file import read_site
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell
from tests.monitor.broker import PATIENCE, Broker, free_port, until


def test_a_site_is_made_of_the_sample(shell: Shell, tmp_path: Path) -> None:
    answer = shell(
        "nodes", "make-site", str(tmp_path / "or"), "--port", "18999", "--format", "json"
    )
    assert answer.status == 0
    said = json.loads(answer.out)
    assert said["site"] == "or-2"
    assert len(said["nodes"]) == 8
    folder = tmp_path / "or"
    assert 'broker = "localhost:18999"' in (folder / "registration-room.toml").read_text("utf-8")
    assert "listener 18999 127.0.0.1" in (folder / "mosquitto.conf").read_text("utf-8")
    for path in (folder / "keys").iterdir():
        private = path.suffix == ".key"
        assert stat.S_IMODE(path.stat().st_mode) == (0o600 if private else 0o644), path.name
        assert (b"PRIVATE KEY" in path.read_bytes()) == private
    assert stat.S_IMODE((folder / "keys").stat().st_mode) == 0o700


def test_each_node_may_write_its_own_topics_and_studio_none(tmp_path: Path) -> None:
    made = front.make_site(tmp_path / "or")
    rights = (tmp_path / "or" / "rights.acl").read_text("utf-8").split("\n\n")
    said = {block.splitlines()[0]: block.splitlines()[1:] for block in rights}
    assert said["user studio"] == ["topic read smsl/1/or-2/#"]
    assert said["user drill"] == [
        "topic write smsl/1/or-2/node/drill/status",
        "topic write smsl/1/or-2/run/main/fact/DRILL/0/drill_speed",
        "topic write smsl/1/or-2/run/main/fact/DRILL/0/drill_temperature",
    ]
    writers = [line for lines in said.values() for line in lines if "write" in line]
    assert len(writers) == len(set(writers)) == 8 + len(made.site.speakers)


def test_passwords_stand_in_no_file_of_the_broker(shell: Shell, tmp_path: Path) -> None:
    folder = tmp_path / "or"
    assert shell("nodes", "make-site", str(folder), "--login", "password").status == 0
    words = (folder / "keys" / "drill.password").read_text("utf-8").strip()
    assert stat.S_IMODE((folder / "keys" / "drill.password").stat().st_mode) == 0o600
    hashed = (folder / "keys" / "passwords").read_text("utf-8")
    assert len(words) >= 30
    assert words not in hashed
    assert len(set(hashed.splitlines())) == 9


def test_keys_are_never_replaced(shell: Shell, tmp_path: Path) -> None:
    folder = tmp_path / "or"
    assert shell("nodes", "make-site", str(folder)).status == 0
    before = (folder / "keys" / "drill.key").read_bytes()
    answer = shell("nodes", "make-site", str(folder))
    assert (answer.status, answer.out) == (2, "")
    assert "keys are never replaced" in answer.err
    assert (folder / "keys" / "drill.key").read_bytes() == before


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("make-site", "OR", "--port", "70000"), "the port is 70000"),
        (("make-site", "OR", "--port", "0"), "the port is 0"),
        (("make-site", "OR", "--days", "0"), "0 days is no validity"),
        (("make-site", "OR", "--host", "a b"), "no name of a computer"),
        (("make-site", "OR", "--host", "x\nlistener 1"), "no name of a computer"),
        (("run", "OR"), "nodes run needs a broker"),
        (("run", "OR", "--broker", "host:port"), "the broker is 'host:port'"),
        (("run", "OR", "--broker", "localhost"), "No such file"),
    ],
)
def test_what_makes_no_sense(
    shell: Shell, tmp_path: Path, words: tuple[str, ...], said: str
) -> None:
    answer = shell("nodes", *(str(tmp_path / "or") if word == "OR" else word for word in words))
    assert answer.status == 2
    assert said in answer.err
    assert not (tmp_path / "or").exists()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[node.Eye]\ntitle = 'Eye'\nkind = 'device'", "'Eye' is no name for a node"),
        ("[node.studio]\ntitle = 'Eye'\nkind = 'device'", "'studio' is no name for a node"),
        ("[node.eye]\ntitle = 'Eye'\nkind = 'ghost'", "node.eye.kind"),
        ("[node.eye]\ntitle = 'Eye'\nkind = 'team'\nfacts = {'SB' = 'e'}", "'SB' is no fact"),
        ("[node.eye]\ntitle = 'E'\nkind = 'team'\nfacts = {'SB/0' = 'e'}\n[node.ear]\ntitle = 'E'\n"
         "kind = 'team'\nfacts = {'SB/0' = 'e'}", "e of SB/0 belongs to eye and ear"),
        ("[node.eye]\ntitle = 'E'\nkind = 'team'\nplace = [nan, 1]", "node.eye.place"),
        ("[[[", "no valid TOML"),
    ],
)  # fmt: skip
def test_a_site_file_that_is_none(shell: Shell, tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "site.toml").write_text(text, "utf-8")
    answer = shell("nodes", "make-site", str(tmp_path))
    assert answer.status == 2
    assert f"{tmp_path / 'site.toml'}:" in answer.err
    assert said in answer.err
    assert not (tmp_path / "keys").exists()


def test_a_program_lies_beside_the_site_file(tmp_path: Path) -> None:
    for program, words in (("../evil.py", "no program's name"), ("evil.py", "there is no evil.py")):
        text = f"[node.eye]\ntitle = 'Eye'\nkind = 'device'\nprogram = '{program}'"
        (tmp_path / "site.toml").write_text(text, "utf-8")
        with pytest.raises(PluginError, match=words):
            open_nodes(tmp_path, "localhost", lambda node, line: None)


@pytest.fixture(scope="module")
def broker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Broker]:
    folder = tmp_path_factory.mktemp("or") / "or"
    port = free_port()
    made = front.make_site(folder, port=port)
    one = Broker(folder, port, made.configuration)
    yield one
    one.kill()


def test_the_room_runs_to_its_goal_and_all_nodes_end(broker: Broker, shell: Shell) -> None:
    """All eight nodes with TLS: the drill fault keeps the run from its goal, without it is
    reached."""
    folder = broker.folder
    process = subprocess.Popen(
        [sys.executable, "-m", "smsl_studio", "nodes", "run", str(folder), "--broker",
         f"localhost:{broker.port}", "--fault", "drill=hot"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        heard: set[str] = set()
        while len(heard) < len(read_site(folder).nodes):
            line = process.stdout.readline()
            assert line, "the nodes ended"
            if "connected to" in line:
                heard.add(line.split(":")[0])
        file = str(folder / "registration-room.json")
        refused = shell("run", file, "--world", "table")
        assert refused.status == 1
        assert "Drill stands still and is cool of DRILL reads 0, not 1" in refused.out
        process.stdin.write("drill good\nnobody silent\n")
        process.stdin.flush()
        while "drill: fault: good" not in line:
            line = process.stdout.readline()
        reached = shell("run", file, "--world", "table")
        assert reached.status == 0, reached.out
    finally:
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE)
    assert process.returncode == 128 + signal.SIGTERM


def test_no_node_outlives_its_parent(broker: Broker) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "smsl_studio", "nodes", "run", str(broker.folder), "--broker",
         f"localhost:{broker.port}"],
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    process.stdout.readline()
    children = _children(process.pid)
    assert children
    process.kill()
    process.communicate(timeout=PATIENCE)
    until(lambda: not any(Path(f"/proc/{one}").exists() for one in children), "they have ended")


def _children(pid: int) -> list[int]:
    found = Path(f"/proc/{pid}/task/{pid}/children").read_text("utf-8").split()
    return [int(one) for one in found]


def test_the_sample_site_has_a_program_for_every_node() -> None:
    nodes = open_nodes(samples_dir() / "nodes", "localhost:1883", lambda node, line: None)
    assert {one.kind for one in nodes.site.nodes.values()} == {
        "device", "instrument", "team", "person",
    }  # fmt: skip
