"""One line for each command that reads a blueprint, made from the arguments that it requires.

So a new command is held against hostile names, foreign imports and interrupted saves by itself.
"""

from __future__ import annotations

import argparse
import re
import sys
from importlib import import_module

from smsl_studio.cli.arguments import COMMANDS, ArgumentParser
from smsl_studio.cli.output import Output

VALUES = {
    "--world": "table",
    "--from": "FROM",
    "--to": "TO",
    "--sb": "SB",
    "--states": "FROM",
    "--as": "NEW",
    "--key": "KEY",
    "--edge": "FROM",
    "--seeds": "1",
}
"""What stands for a required option. FROM and TO are states, FILE and OTHER are blueprints."""
FILES = {"diff": ("FILE", "OTHER"), "merge": ("FILE", "FILE", "OTHER", "-o", "OUT.json")}
"""The words of the commands that take more than one file."""
NO_BLUEPRINT = ("open", "replay", "worlds", "plugins", "git-setup", "keys", "store", "nodes",
                "generate", "serve")  # fmt: skip


def calls() -> dict[str, list[str]]:
    """Each command with its words. Nothing but ``OUT.*`` is written."""
    return {name: _call(name) for name in COMMANDS if name not in NO_BLUEPRINT}


def json_calls() -> dict[str, list[str]]:
    """Those that give JSON, asked for it."""
    json = ("--format", "json")
    return {
        name: [*words, *json] for name, words in calls().items() if "--format" in _options(name)
    }


def filled(words: list[str], values: dict[str, str]) -> list[str]:
    """A command line with values in the place of FILE, OTHER, FROM, TO and OUT."""
    found = []
    for word in words:
        stem, dot, suffix = word.partition(".")
        found.append(values.get(stem, stem) + dot + suffix)
    return found


def _call(name: str) -> list[str]:
    words = [name, *FILES.get(name, ("FILE",))]
    for option, action in _options(name).items():
        if option == "--check":
            words.append(option)
        elif action.required and option in action.option_strings:
            words += [option, VALUES.get(option) or f"OUT{_suffix(action)}"]
    return words


def _suffix(action: argparse.Action) -> str:
    found = re.search(r"\.\w+", action.help or "")
    assert found, f"{action.option_strings} is required: VALUES has no word for it"
    return found[0]


def _options(name: str) -> dict[str, argparse.Action]:
    """The options of a command, each by its first name."""
    parser = ArgumentParser(name, Output(sys.stdout))
    import_module(f"smsl_studio.cli.{name.replace('-', '_')}").add_arguments(parser)
    return {one.option_strings[0]: one for one in parser._actions if one.option_strings}
