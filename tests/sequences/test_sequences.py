"""After each act of any sequence all parts of the window agree, and saved files read back equal.

The bench runs ten thousand sequences (``benches/sequences.py``); here are a few, each shorter.
"""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.document import afterwards
from tests.sequences.shares import findings

SHARE, LENGTH = 8, 10


@pytest.mark.parametrize("share", range(4))
def test_after_each_act_all_that_is_shown_agrees(
    qapp: QApplication, monkeypatch: pytest.MonkeyPatch, share: int
) -> None:
    monkeypatch.setattr(afterwards, "MOMENT", 60)
    assert not list(findings(share * SHARE, (share + 1) * SHARE, LENGTH))
