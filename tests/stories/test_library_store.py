"""The library shows the user's store, and its marks follow what is signed and revoked."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

import smsl_studio as smsl
from smsl_studio.front.key_ring import revoke_digest
from smsl_studio.front.revocations import dependants_of
from smsl_studio.front.store_shelf import add_blueprint
from smsl_studio.inspection.approval.shelf import StoredBlueprint
from smsl_studio.studio.base.rows import ListRow
from smsl_studio.studio.features.approval import store_watch
from tests.approval import DOOR
from tests.stories.conftest import Sit
from tests.stories.person import Person

WORDS = b"correct horse"
KNEE = {
    "KNEE": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"bend": "State_1"},
        "State_1": {"stretch": "State_0"},
    }
}


@pytest.fixture(autouse=True)
def often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store_watch, "WATCH", 50)


def written(folder: Path, name: str, values: object) -> Path:
    path = folder / name
    path.write_text(json.dumps(values), "utf-8")
    return path


def signed(file: Path) -> StoredBlueprint:
    """Sign a blueprint and put it into the store, swept in the table world."""
    smsl.approve(smsl.ApprovalRequest(smsl.read(file), "ada", WORDS))
    return add_blueprint(smsl.read(file), "table", by="Ada Lovelace")


def shown(person: Person) -> list[ListRow]:
    """The rows of the library below the heading of the store."""
    rows = list(person.window.library.list.rows.rows)
    at = next((n for n, row in enumerate(rows) if row.text.startswith("From your store")), None)
    return [] if at is None else rows[at + 1 :]


def marks(person: Person) -> dict[str, str]:
    return {row.text: row.right for row in shown(person)}


def test_blueprints_and_operations_of_the_store_stand_in_the_library_with_their_mark(
    sit: Sit, tmp_path: Path
) -> None:
    smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
    person = sit(written(tmp_path, "door.json", DOOR))
    assert marks(person) == {}
    part = signed(written(tmp_path, "knee.json", KNEE))
    person.until(lambda: marks(person).get("knee") == "Approved by 1")
    assert marks(person)["bend"] == "1 of 1 in table"
    over = {
        "LEG": {
            "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
            "_operations": {
                "Op": {"binding": {"blueprint": f"store:{part.digest}", "goal": "KNEE/State_1"}}
            },
            "State_0": {"Op": "State_1"},
            "State_1": {"Back": "State_0"},
        }
    }
    add_blueprint(smsl.read(written(tmp_path, "leg.json", over)))
    person.until(lambda: marks(person).get("leg") == "Uninspected")
    library = person.window.library
    library.filter.setText("stretch")
    assert [row.text for row in shown(person)] == ["knee", "stretch"]
    library.filter.setText("")
    row = person.row(library.list, "knee")
    library.list.setFocus()
    library.list.setCurrentIndex(row)
    QTest.keyClick(library.list, Qt.Key.Key_Return)
    assert QGuiApplication.clipboard().text() == f"store:{part.digest}"
    assert {one.file for one in dependants_of(part.digest)} >= {"leg.json"}
    revoke_digest(part.digest, "a wrong angle", "ada", WORDS)
    person.until(lambda: marks(person).get("leg") == "Revoked")
    assert marks(person)["knee"] == "Revoked"
    assert marks(person)["bend"] == "Revoked", "a sweep of it does not count any more"
    assert all(row.severity == "E" for row in shown(person))
    assert "a wrong angle" in next(row.tip for row in shown(person) if row.text == "leg")


def test_a_store_that_cannot_be_read_is_told(sit: Sit, tmp_path: Path) -> None:
    stored = add_blueprint(smsl.read(written(tmp_path, "knee.json", KNEE)))
    entry = stored.file
    while not (entry / "entry.json").exists():
        entry = entry.parent
    (entry / "entry.json").write_text("{}", "utf-8")
    person = sit(written(tmp_path, "door.json", DOOR))
    person.until(lambda: bool(shown(person)))
    (row,) = shown(person)
    assert row.text == "The store cannot be read"
    assert row.tip
