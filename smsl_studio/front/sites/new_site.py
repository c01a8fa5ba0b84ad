"""Makes a site: an authority, certificates or passwords, and what the broker must know.

``keys/`` has a login for each node and for Studio. Nobody but the user can read its private parts.
If the folder has no site file yet, the sample site is put there: nodes, a blueprint and its
bindings.
"""

from __future__ import annotations

import getpass
import os
import re
import secrets
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from smsl_studio.errors import SaveError, UsageError
from smsl_studio.front.sites.broker_files import (
    STUDIO,
    configuration,
    login_file,
    password_file,
    rights,
)
from smsl_studio.front.sites.site_file import FILE, Site, read_site
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.disk import write_new

PORT = 8883
DAYS = 365
MOST_DAYS = 3650
LOCAL = ("localhost", "127.0.0.1", "::1")
"""The names of this computer, which every broker's certificate has."""
LOGINS = ("certificate", "password")
BROKER = 'broker = "localhost:8883"'
"""The line of the sample's bindings that names the broker."""
_HOST = re.compile(r"[A-Za-z0-9:]([A-Za-z0-9.:-]{0,250}[A-Za-z0-9])?")
_SAMPLE = re.compile(r".*\.(toml|json|py)")

KEYS = "keys"
"""The folder of certificates and keys below that of a site."""


@dataclass(frozen=True)
class NewSite:
    """A site that was made: its value, the files that were written, and until when it is valid."""

    site: Site
    files: tuple[Path, ...]
    configuration: Path
    days: int


def make_site(
    folder: str | os.PathLike[str],
    *,
    hosts: Sequence[str] = (),
    port: int = PORT,
    days: int = DAYS,
    login: str = "certificate",
    now: datetime | None = None,
) -> NewSite:
    """Make authority, certificates, broker configuration and rights for the site in a folder.

    ``hosts`` are names or addresses by which nodes call the broker from other computers. Without
    them it listens to this computer only. ``login`` is ``certificate`` or ``password``. ``now`` is
    the beginning of the certificates; None is the clock of this computer.

    UsageError if the folder has keys already or an argument makes no sense, PluginError if its site
    file is not valid, SaveError if a file cannot be written.

    >>> made = make_site("theatre")
    >>> sorted(made.site.nodes)[:3]
    ['badge-reader', 'drill', 'imaging-arm']
    """
    where = Path(folder).absolute()
    _check(where, hosts, port, days, login)
    written: list[Path] = []
    try:
        where.mkdir(parents=True, exist_ok=True)
        if not os.path.lexists(where / FILE):
            for name, raw in _sample(port):
                _write(where / name, raw, written)
        site = read_site(where)
        (where / KEYS).mkdir(mode=0o700)
        certified = login == "certificate"
        moment = datetime.now(UTC) if now is None else now
        for name, raw, private in _secrets(site, hosts, days, moment, certificates=certified):
            _write(where / KEYS / name, raw, written, 0o600 if private else 0o644)
        listens = "" if hosts else "127.0.0.1"
        conf = where / "mosquitto.conf"
        text = configuration(where, port, listens, _owner(), certificates=certified)
        for path, words in ((conf, text), (where / "rights.acl", rights(site))):
            with suppress(FileNotFoundError):
                path.unlink()
            _write(path, words.encode(), written)
    except OSError as error:
        words = f"the site in {where} was not made: {error.strerror or error}"
        raise SaveError(words, advice="Take what was written away, then make it anew.") from None
    return NewSite(site, tuple(written), conf, days)


def _check(folder: Path, hosts: Sequence[str], port: int, days: int, login: str) -> None:
    """Raise UsageError if an argument makes no sense, or if keys would be replaced."""
    if login not in LOGINS:
        raise UsageError(f"the login is {login!r}, not one of {', '.join(LOGINS)}")
    if not 0 < port < 65536:
        raise UsageError(f"the port is {port}", advice="Give a number from 1 to 65535.")
    if not 0 < days <= MOST_DAYS:
        raise UsageError(f"{days} days is no validity", advice=f"Give 1 to {MOST_DAYS} days.")
    for host in hosts:
        if not _HOST.fullmatch(host):
            raise UsageError(f"{host!r} is no name of a computer", advice="Write HOST or address.")
    if any(ord(one) < 32 for one in str(folder)):
        raise UsageError(f"mosquitto cannot read the name of {str(folder)!r}")
    if os.path.lexists(folder) and not folder.is_dir():
        raise UsageError(f"{folder} is no folder", advice="Name another one.")
    if os.path.lexists(folder / KEYS):
        raise UsageError(
            f"{folder / 'keys'} is there already, and keys are never replaced",
            advice="Take it away first. All nodes need their new keys then.",
        )


def _owner() -> str:
    """Return the name of the user who makes the site, empty where that is not known."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def _sample(port: int) -> Iterator[tuple[str, bytes]]:
    """The files of the sample site, with this port in the bindings."""
    for path in sorted((samples_dir() / "nodes").iterdir()):
        if path.is_file() and _SAMPLE.fullmatch(path.name):
            raw = path.read_bytes()
            if path.suffix == ".toml":
                raw = raw.replace(BROKER.encode(), f'broker = "localhost:{port}"'.encode())
                raw = raw.replace(b"# login =", b"login =")
            yield path.name, raw


def _secrets(
    site: Site, hosts: Sequence[str], days: int, now: datetime, *, certificates: bool
) -> Iterator[tuple[str, bytes, bool]]:
    """Each file of ``keys/``: its name, its bytes, and whether it is private."""
    from smsl_studio.seal.certificates import new_authority, new_certificate

    authority = new_authority(f"{site.name} authority"[:64], now, days)
    yield "authority.pem", authority.certificate, False
    yield "authority.key", authority.private, True
    names = tuple(dict.fromkeys((*LOCAL, *hosts)))
    broker = new_certificate(authority, "broker", now, days, names)
    yield "broker.pem", broker.certificate, False
    yield "broker.key", broker.private, True
    passwords: dict[str, str] = {}
    for name in (STUDIO, *site.nodes):
        if certificates:
            made = new_certificate(authority, name, now, days)
            yield f"{name}.pem", made.certificate, False
            yield f"{name}.key", made.private, True
        else:
            passwords[name] = secrets.token_urlsafe(24)
            yield f"{name}.password", f"{passwords[name]}\n".encode(), True
        yield f"{name}.toml", login_file(name, certificates=certificates).encode(), False
    if passwords:
        yield "passwords", password_file(passwords).encode(), True


def _write(path: Path, raw: bytes, written: list[Path], mode: int = 0o644) -> None:
    write_new(path, raw, mode)
    written.append(path)
