"""Until when the certificate of a node is valid, as far as this computer has it."""

from __future__ import annotations

from datetime import UTC, datetime

from smsl_studio.errors import SealError
from smsl_studio.front.sites.login_file import LARGEST
from smsl_studio.front.sites.new_site import KEYS
from smsl_studio.front.sites.site_file import Site
from smsl_studio.smsl.inputs import read_ordinary

ELSEWHERE = "its file is not on this computer"


def certificate_words(site: Site, node: str, now: datetime | None = None) -> str:
    """Return what is known of a node's certificate, such as ``until 12 Mar 2027``.

    Without ``now`` the clock of this computer counts. It is the file that ``nodes make-site`` has
    written; the broker alone knows which one the node has shown.
    """
    try:
        raw = read_ordinary(str(site.folder / KEYS / f"{node}.pem"), LARGEST).raw
    except OSError:
        return ELSEWHERE
    # cryptography takes time to load.
    from smsl_studio.seal.certificates import validity

    try:
        since, until = validity(raw)
    except SealError:
        return "its file is no certificate"
    moment = datetime.now(UTC) if now is None else now
    if moment > until:
        return f"expired on {until:%d %b %Y}"
    return f"until {until:%d %b %Y}" if moment >= since else f"valid only from {since:%d %b %Y} on"
