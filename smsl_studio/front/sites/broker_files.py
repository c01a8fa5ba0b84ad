"""What mosquitto reads for a site: its configuration, the rights of each node, and passwords.

A node may write its own status and its own facts, and read nothing. Studio may read everything of
the site and write nothing. So no node can speak for another, and Studio disturbs nobody.
"""

from __future__ import annotations

import base64
import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from smsl_studio.front.sites.site_file import Site
from smsl_studio.monitor.topics import START, StatusTopic, written

STUDIO = "studio"
"""The name under which Studio logs in."""
LARGEST = 65536
"""The largest packet, in bytes. Studio asks for the same."""
_ROUNDS = 10_000
_SALT = 12


def configuration(
    folder: Path, port: int, listens: str, owner: str = "", *, certificates: bool
) -> str:
    """Return ``mosquitto.conf``.

    ``listens`` is an address of this computer; empty means all. A broker that root has started runs
    as the ``owner`` of the keys, because nobody else can read them.
    """
    keys = folder / "keys"
    who = (
        ["require_certificate true", "use_identity_as_username true"]
        if certificates
        else ["require_certificate false", f"password_file {keys / 'passwords'}"]
    )
    lines = [
        "# Made by smsl-studio nodes make-site. Start it with: mosquitto -c THIS_FILE",
        f"listener {port} {listens}".strip(),
        f"cafile {keys / 'authority.pem'}",
        f"certfile {keys / 'broker.pem'}",
        f"keyfile {keys / 'broker.key'}",
        "tls_version tlsv1.2",
        *who,
        *([f"user {owner}"] if owner else ()),
        "allow_anonymous false",
        f"acl_file {folder / 'rights.acl'}",
        "persistence false",
        f"max_packet_size {LARGEST}",
        "max_keepalive 60",
        "log_dest stderr",
    ]
    return "\n".join(lines) + "\n"


def rights(site: Site) -> str:
    """Return ``rights.acl``: the topics of each node, and those of Studio."""
    lines = [f"user {STUDIO}", f"topic read {START}{written(site.name)}/#"]
    for name in site.nodes:
        lines += ["", f"user {name}", f"topic write {StatusTopic(site.name, name)}"]
        lines += [f"topic write {topic}" for topic in site.topics(name)]
    return "\n".join(lines) + "\n"


def password_file(passwords: Mapping[str, str]) -> str:
    """Return the file of passwords. It has none of them, only a hash of each (PBKDF2, SHA-512)."""
    lines = []
    for name, password in passwords.items():
        salt = os.urandom(_SALT)
        hashed = hashlib.pbkdf2_hmac("sha512", password.encode(), salt, _ROUNDS)
        lines.append(f"{name}:$7${_ROUNDS}${_text(salt)}${_text(hashed)}")
    return "\n".join(lines) + "\n"


def login_file(name: str, *, certificates: bool) -> str:
    """Return the login file of a node or of Studio (see ``login_file``)."""
    lines: Sequence[str] = (
        [f'certificate = "{name}.pem"', f'key = "{name}.key"']
        if certificates
        else [f'user = "{name}"', f'password = "{name}.password"']
    )
    return "\n".join(['authority = "authority.pem"', *lines]) + "\n"


def _text(raw: bytes) -> str:
    return base64.b64encode(raw).decode()
