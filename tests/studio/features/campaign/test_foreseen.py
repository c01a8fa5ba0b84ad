"""The filter of a campaign: only what ended otherwise than foreseen."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from pytestqt.qtbot import QtBot

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_runs import Injection, RunVerdict
from smsl_studio.front.fault_foresight import FaultEnd
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.campaign.page import CampaignPage
from smsl_studio.studio.features.campaign.work import CampaignWork

EDGES = (Address("SB1", "State_aa", "Op_1b"), Address("SB1", "State_ba", "Op_2c"))


def test_the_filter_keeps_what_ended_otherwise_and_offers_a_finding(qtbot: QtBot) -> None:
    home = QObject()
    work = CampaignWork(home)
    work.request = CampaignRequest(smsl.read(Path(samples_dir() / "hanoi-2.json")), seeds=1)
    work.tally.begin([Injection("slip", edge) for edge in EDGES], 1)
    for row, end in enumerate(("reached", "reached")):
        work.tally.foresee(row, FaultEnd(end, "another way leads there", ("a", "b")))
    work.tally.hear(0, 0, RunVerdict(False, False, "held", "0" * 64))
    work.tally.hear(1, 0, RunVerdict(True, True, "goal_reached", "0" * 64))
    page = CampaignPage(work, LIGHT)
    qtbot.addWidget(page)
    page.show_drawing(work.request.blueprint)
    page.show()
    qtbot.waitUntil(lambda: page.differ.text().endswith("  1"))
    told: list[tuple[object, ...]] = []
    page.finding_wanted.connect(lambda *words: told.append(words))
    page.differ.click()
    assert [page.table.isRowHidden(row) for row in range(3)] == [False, True, False]
    page.table.choose(str(EDGES[1]), "slip")
    assert not page.side.finding.isVisible()
    page.table.choose(str(EDGES[0]), "slip")
    assert "They ended otherwise" in page.side.foreseen.text()
    page.side.finding.click()
    assert told == [(work.tally.cells[0],)]
    page.differ.click()
    assert not page.table.isRowHidden(1)
