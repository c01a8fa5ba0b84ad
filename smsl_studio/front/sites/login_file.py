"""Login files: how a program logs in at a broker with TLS.

::

    authority = "authority.pem"
    certificate = "studio.pem"
    key = "studio.key"

In the place of ``certificate`` and ``key`` there may be ``user`` and ``password``; ``password`` is
the name of a file, too. All names are relative to the login file.
"""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from smsl_studio.errors import Place, PluginError, RunRefused, SealError, UsageError
from smsl_studio.library.toml_text import read_toml
from smsl_studio.monitor.login import Login
from smsl_studio.smsl.inputs import read_ordinary

LARGEST = 65_536
"""The largest size of a login file, a certificate or a key, in bytes."""
ADVICE = "Write authority, and certificate and key, or user and password."


class _LoginFile(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    authority: str
    certificate: str = ""
    key: str = ""
    user: str = ""
    password: str = ""


def read_login(path: Path, now: datetime | None = None) -> Login:
    """Read a login file, and see that its certificate is valid ``now``.

    RunRefused if it is not, UsageError or PluginError if a file cannot be used. Without ``now`` the
    clock of this computer counts.
    """
    text, values = read_toml(path, LARGEST)
    try:
        said = _LoginFile.model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        word = str(fault["loc"][0])
        raise PluginError(f"{word}: {fault['msg']}", text.place(word), ADVICE) from None
    if bool(said.certificate) == bool(said.user) or bool(said.certificate) != bool(said.key):
        words = "it must have a certificate and its key, or a user and a password"
        raise PluginError(words, Place(str(path), 1, 1), ADVICE)
    beside = path.parent
    authority = beside / said.authority
    _see_valid(authority, now, text.place("authority"))
    if said.certificate:
        certificate = beside / said.certificate
        _see_valid(certificate, now, text.place("certificate"))
        return Login(path, authority, certificate, beside / said.key)
    place = text.place("password")
    password = _read(beside / said.password, place).decode("utf-8", "replace").strip()
    if not password:
        raise UsageError("the password is empty", place, "Make the site anew.")
    return Login(path, authority, user=said.user, password=password)


def _see_valid(path: Path, now: datetime | None, place: Place) -> None:
    """Raise RunRefused if the certificate in a file is not valid now, UsageError if it is none."""
    raw = _read(path, place)
    # cryptography is loaded only if a login is read.
    from smsl_studio.seal.certificates import validity

    try:
        since, until = validity(raw)
    except SealError as error:
        raise UsageError(f"{path}: {error.sentence}", place, error.advice) from None
    moment = datetime.now(UTC) if now is None else now
    if moment > until:
        words = f"the certificate {path} has expired on {until:%d %b %Y}"
        raise RunRefused(words, place, "Make the site anew: smsl-studio nodes make-site FOLDER.")
    if moment < since:
        words = f"the certificate {path} is valid only from {since:%d %b %Y} on"
        raise RunRefused(words, place, "Look at the clock of this computer.")


def _read(path: Path, place: Place) -> bytes:
    try:
        return read_ordinary(str(path), LARGEST).raw
    except OSError as error:
        raise UsageError(f"{path} cannot be read: {error.strerror}", place, ADVICE) from None
