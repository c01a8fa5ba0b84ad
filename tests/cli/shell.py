"""The command line, called in this process."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest

from smsl_studio.cli import main
from smsl_studio.shipped import samples_dir


@dataclass(frozen=True)
class Answer:
    """What a command answered."""

    status: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)

    @property
    def lines(self) -> list[Any]:
        return [json.loads(line) for line in self.out.splitlines()]


Shell = Callable[..., Answer]


def sample(name: str) -> str:
    return str(samples_dir() / f"{name}.json")


def make_shell(capsys: pytest.CaptureFixture[str]) -> Shell:
    def call(*argv: str) -> Answer:
        capsys.readouterr()
        status = main(argv)
        said = capsys.readouterr()
        return Answer(status, said.out, said.err)

    return call
