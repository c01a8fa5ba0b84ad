"""What the page Room says of the certificate of a node."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path

from smsl_studio.front.sites.new_site import KEYS, make_site
from smsl_studio.front.sites.node_certificate import ELSEWHERE, certificate_words


def test_it_says_until_when_it_is_valid(tmp_path: Path) -> None:
    site = make_site(tmp_path / "theatre", days=30).site
    now = datetime.now(UTC)
    until = now + timedelta(days=30)
    assert certificate_words(site, "drill") == f"until {until:%d %b %Y}"
    late = certificate_words(site, "drill", now + timedelta(days=31))
    assert late == f"expired on {until:%d %b %Y}"
    early = certificate_words(site, "drill", now - timedelta(days=2))
    assert early.startswith("valid only from ")
    assert certificate_words(site, "nobody") == ELSEWHERE
    (tmp_path / "theatre" / KEYS / "drill.pem").write_text("none", "utf-8")
    assert certificate_words(site, "drill") == "its file is no certificate"
