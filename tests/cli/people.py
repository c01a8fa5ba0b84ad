"""People with keys in the store of a test, at the command line."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from tests.approval import DOOR, PASSPHRASE, make_keys_cheap
from tests.cli.shell import Answer, Shell


@dataclass(frozen=True)
class Desk:
    """A folder with a blueprint, and the command line; the passphrase stands in the environment."""

    shell: Shell
    folder: Path

    @property
    def file(self) -> str:
        return str(self.folder / "door.json")

    @property
    def record(self) -> Path:
        return self.folder / "door.json.record.json"

    def write(self, values: dict[str, Any] = DOOR, name: str = "door.json") -> str:
        """Write a blueprint; return its name."""
        path = self.folder / name
        path.write_text(json.dumps(values, indent=1), "utf-8")
        return str(path)

    def key(self, person: str, role: str, key_id: str) -> dict[str, Any]:
        """Make a key."""
        answer = self(
            *("keys", "make", "--person", person, "--role", role, "--id", key_id),
            *("--format", "json"),
        )
        assert answer.status == 0, answer.err
        return dict(answer.json)

    def approve(self, key: str, *more: str) -> Answer:
        """Approve the blueprint."""
        return self.shell("approve", self.file, "--key", key, *more)

    def verify(self, *more: str) -> Answer:
        """Verify the blueprint; the answer is JSON."""
        return self.shell("verify", self.file, *more, "--format", "json")

    def codes(self, *more: str) -> list[str]:
        """The codes of the refusals of ``verify``."""
        answer = self.verify(*more)
        assert answer.status == (0 if answer.json["verdict"] == "approved" else 1)
        return [one["code"] for one in answer.json["refusals"]]

    def run(self, *more: str) -> tuple[Answer, dict[str, Any]]:
        """Run the blueprint in the table world. The answer, and its last event."""
        answer = self.shell("run", self.file, "--world", "table", *more, "--format", "json")
        return answer, answer.lines[-1]

    def __call__(self, *words: str) -> Answer:
        return self.shell(*words)


def make_desk(shell: Shell, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Desk:
    """A desk with the blueprint that is approved, and Ada's key."""
    monkeypatch.setenv("SMSL_PASSPHRASE", PASSPHRASE)
    make_keys_cheap(monkeypatch)
    desk = Desk(shell, folder)
    desk.write()
    desk.key("Ada Lovelace", "engineer", "ada")
    return desk
