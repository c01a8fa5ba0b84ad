"""After a stop with a disk in the air the card of the hold says what helps."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.front.views.hold_advice import ADVICE
from smsl_studio.studio.running.hold_card import HoldCard
from tests.plugins.hanoi_game import SAMPLES


def test_a_hold_with_a_disk_in_the_air_says_what_helps(qapp: QApplication, qtbot: QtBot) -> None:
    run = open_run(read(SAMPLES / "hanoi-2.json"), "hanoi", host="local", attended=True)
    card = HoldCard()
    qtbot.addWidget(card)
    run.open()
    while run.time < 1.5:
        run.tick()
    run.stop()
    run.tick()
    card.show_status(run.status, True)
    assert card.advice == "", "a stop is no fault"
    run.reset()
    run.tick()
    run.resume()
    while run.status.phase != "fault_hold":
        run.tick()
    card.show_status(run.status, True)
    card.show()
    assert card.advice == ADVICE
    assert "adopt" not in [offer.command for offer in run.status.offers]
    run.close()
