"""The program: help, versions, plugins, wrong words; and how it behaves in a pipe."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from inspect import signature
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.cli.arguments import COMMANDS
from smsl_studio.front import VERBS
from tests.cli.shell import Shell, sample
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_allowed

PAGE = Path(__file__).parents[2] / "docs" / "command-line.md"


def _start(*argv: str, stdout: int = subprocess.PIPE) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "smsl_studio", *argv],
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[2],
    )


def test_help_lists_the_commands_and_no_others(shell: Shell) -> None:
    for argv in ([], ["--help"], ["-h"]):
        answer = shell(*argv)
        assert answer.status == 0
        lines = [line for line in answer.out.splitlines() if line.startswith("  ")]
        listed = [line.split()[0] for line in lines if line[2] != " "]
        assert listed == [*COMMANDS, "-h,", "-V,"]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(shell: Shell, command: str) -> None:
    answer = shell(command, "--help")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.startswith(f"usage: smsl-studio {command}")


def test_the_page_has_a_row_for_every_command() -> None:
    """Where this fails, the missing rows are put into the table at the top of the page."""
    page = PAGE.read_text("utf-8").splitlines()
    assert [line for line in map(row, COMMANDS) if line not in page] == []


def test_the_page_tells_the_usage_of_every_command() -> None:
    page = PAGE.read_text("utf-8")
    assert [name for name in COMMANDS if f"`smsl-studio {name}" not in page] == []


def row(command: str) -> str:
    """The row of the page: what a command does, and what does it from Python."""
    verb = VERBS.get(command)
    calls = [f"`smsl.{name}({needed(name)})`" for name in (verb.functions if verb else ())]
    return f"| `{command}` | {COMMANDS[command]} | {', '.join(calls)} |"


def needed(function: str) -> str:
    """What a function of the package cannot do without."""
    parameters = signature(getattr(smsl, function)).parameters.values()
    return ", ".join(one.name for one in parameters if one.default is one.empty)


def test_the_version_is_one_line(shell: Shell) -> None:
    answer = shell("--version")
    assert answer.status == 0
    assert answer.out.startswith("smsl-studio ")
    assert answer.out.count("\n") == 1


@pytest.mark.parametrize(
    ("argv", "advice"),
    [
        (["chekc", "x.json"], "Did you mean check?"),
        (["--frob"], "--help"),
        (["check"], "smsl-studio check --help"),
        (["check", "--frob", "x.json"], "smsl-studio check --help"),
        (["check", "--rule", "R99", "x.json"], "R"),
        (["check", "no/such/file.json"], "Check the path"),
    ],
)
def test_wrong_words_are_two_sentences(shell: Shell, argv: list[str], advice: str) -> None:
    answer = shell(*argv)
    assert (answer.status, answer.out) == (2, "")
    first, second = answer.err.splitlines()
    assert first
    assert advice in second


def test_worlds_and_plugins_say_what_there_is_and_what_is_broken(shell: Shell, home: Path) -> None:
    write_allowed(home, "lamp", LAMP_PLUGIN)
    broken = write_allowed(home, "broken", "def register(library):\n    1 / 0\n")
    worlds = shell("worlds", "--format", "json")
    assert worlds.status == 0
    assert {"table", "lamp", "hanoi"} <= {world["name"] for world in worlds.json["worlds"]}
    plugins = shell("plugins", "--format", "json").json
    lamp = next(plugin for plugin in plugins["plugins"] if plugin["name"] == "lamp")
    assert (lamp["source"], lamp["worlds"]) == ("user", ["lamp"])
    assert {"function": "lamp.switch", "pattern": "Op_{to}"} in lamp["operations"]
    hanoi = next(plugin for plugin in plugins["plugins"] if plugin["name"] == "hanoi")
    blocked = {"world": "hanoi", "fault": "blocked_peg", "parameters": ["peg", "seconds"]}
    assert blocked in hanoi["world_faults"]
    assert "blocked_peg(peg, seconds), tower_carried, " in shell("plugins").out
    (fault,) = plugins["faults"]
    assert (fault["plugin"], fault["line"]) == ("broken", 2)
    assert fault["file"] == str(broken / "plugin.py")
    for command in ("worlds", "plugins"):
        text = shell(command).out
        assert "lamp" in text
        assert f"{broken}/plugin.py:2:1: the plugin 'broken' did not load: Zero" in text


def test_a_reader_that_goes_away_is_no_traceback() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with _start("check", sample("hanoi"), stdout=writer) as program:
        os.close(writer)
        _, err = program.communicate(timeout=60)
    assert (program.returncode, err) == (1, "")


def test_what_library_code_writes_below_python_is_no_data(home: Path, tmp_path: Path) -> None:
    loud = LAMP_PLUGIN.replace('print("switching")', '__import__("os").write(1, b"from below\\n")')
    write_allowed(home, "lamp", loud)
    file = tmp_path / "lamp.json"
    file.write_text(blueprint_of(LAMP).document.text, "utf-8")
    avoid = ("--avoid=State_0/Op_break", "--avoid=State_0/Op_spin")
    with _start("run", str(file), "--world", "lamp", "--format", "json", *avoid) as program:
        out, err = program.communicate(timeout=60)
    assert program.returncode == 0
    assert all(line.startswith('{"event":') for line in out.splitlines())
    assert "from below" in err


def test_ctrl_c_ends_a_run_in_order() -> None:
    argv = ("run", sample("registration"), "--world", "table", "--speed", "0.02")
    with _start(*argv, "--format", "json") as program:
        assert program.stdout is not None
        while "operation_started" not in program.stdout.readline():
            pass
        program.send_signal(signal.SIGINT)
        rest, err = program.communicate(timeout=60)
    assert program.returncode == 1
    assert '"event":"run_finished"' in rest.splitlines()[-1]
    assert '"reason":"stopped"' in rest.splitlines()[-1]
    assert "Traceback" not in err


def test_colours_only_on_a_terminal_that_wants_them(
    shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert "\x1b" not in shell("check", sample("hanoi")).out
    monkeypatch.setattr("_pytest.capture.CaptureIO.isatty", lambda self: True)
    assert "\x1b[31m" in shell("check", sample("hanoi")).out
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in shell("check", sample("hanoi")).out
