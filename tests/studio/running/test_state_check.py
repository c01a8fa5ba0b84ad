"""The state check in Run mode equals the one in Supervise mode."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.check import state_check
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.supervise.facts import check_view
from smsl_studio.studio.running.state_check import StateCheckView
from tests.front.views.statuses import sample, scene, status

SAMPLE = sample("registration-digitization.json")
HERE = {"REGISTRATION": "State110", "DIGITIZATION": "State1"}


@pytest.mark.parametrize(
    ("registered", "said"), [("0", "✓ True"), ("1", "Not true"), (None, "Unknown")]
)
def test_both_say_the_same_of_a_state_that_nothing_leads_to(
    qtbot: QtBot, registered: str | None, said: str
) -> None:
    found = scene(REGISTRATION_0="1", REGISTRATION_2=registered, DIGITIZATION_0="1")
    panel = StateCheckView(LIGHT)
    qtbot.addWidget(panel)
    panel.show_check(
        SAMPLE, state_check(SAMPLE, "REGISTRATION", "State110", found, HERE), waiting=False
    )
    (verdict,) = (one for one in panel.findChildren(QLabel) if one.property("role") == "phase")
    assert verdict.text() == said
    view = check_view(SAMPLE, status(HERE, scene=found), "REGISTRATION")
    assert view is not None
    assert view.verdict == said.removeprefix("✓ ")


def test_while_an_operation_runs_nothing_is_decided_yet(qtbot: QtBot) -> None:
    found = scene(REGISTRATION_0="1", REGISTRATION_2="0", DIGITIZATION_0="1")
    panel = StateCheckView(LIGHT)
    qtbot.addWidget(panel)
    panel.show_check(
        SAMPLE, state_check(SAMPLE, "REGISTRATION", "State110", found, HERE), waiting=True
    )
    (verdict,) = (one for one in panel.findChildren(QLabel) if one.property("role") == "phase")
    assert verdict.text() == "True so far"
