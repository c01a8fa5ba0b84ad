"""An empty blueprint has no errors, and is not called clean either."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key
NOTHING = "Nothing is drawn yet, so nothing was checked. Add the first state."


def told(person: Person) -> tuple[str, str, str]:
    person.until_inspected()
    findings, status = person.window.findings, person.window.status_line
    return findings.summary.text(), findings.empty.text(), status.counts[3].text()


def test_an_empty_page_has_no_error_until_something_is_drawn(sit: Sit) -> None:
    person = sit()
    assert told(person) == ("Nothing to check", NOTHING, "nothing to check")
    assert not person.window.findings.findings
    person.double_click_canvas(person.window.canvas.rect().center())
    person.press(Key.Key_Return)
    assert person.blueprint.state_count == 1
    assert told(person)[0] != "Nothing to check"
    assert person.window.status_line.counts[3].text() != "nothing to check"


@pytest.mark.parametrize(
    ("text", "summary"),
    [
        ("{}", "Nothing to check"),
        ('{"_imports": ["gone.json"]}', "1 error blocks approval"),
        ('{"SB1": {"HEADER": {}, "State0": {}}, "SB2": {"HEADER": {}}}', "1 error blocks approval"),
    ],
)
def test_a_file_without_states_is_not_called_clean(
    sit: Sit, tmp_path: Path, text: str, summary: str
) -> None:
    file = tmp_path / "file.json"
    file.write_text(text)
    assert told(sit(file))[0] == summary
