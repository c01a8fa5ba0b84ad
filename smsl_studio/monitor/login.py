"""The login of a program at a broker: TLS, with a certificate or with a name and a password."""

from __future__ import annotations

import ssl
from dataclasses import dataclass, field
from pathlib import Path

from smsl_studio.errors import Place, UsageError


@dataclass(frozen=True)
class Login:
    """What a program shows to a broker, and what it asks of it.

    ``authority`` is the file of the authority that must have signed the broker's certificate.
    ``certificate`` and ``key`` are files of this program. A program without them has a ``user`` and
    a ``password``.
    """

    file: Path
    authority: Path
    certificate: Path | None = None
    key: Path | None = None
    user: str = ""
    password: str = field(default="", repr=False)

    def context(self) -> ssl.SSLContext:
        """Return the settings of TLS for all connections with this login.

        The broker must show a certificate of the authority for the name under which it is called.
        UsageError if a file cannot be used.
        """
        try:
            context = ssl.create_default_context(cafile=str(self.authority))
        except (OSError, ValueError) as error:
            raise self._unusable(self.authority, error) from None
        context.minimum_version = ssl.TLSVersion.TLSv1_2
        context.sslsocket_class = _ClosedSocket
        if self.certificate is not None:
            try:
                context.load_cert_chain(str(self.certificate), self.key and str(self.key))
            except (OSError, ValueError) as error:
                raise self._unusable(self.certificate, error) from None
        return context

    def _unusable(self, file: Path, error: Exception) -> UsageError:
        words = getattr(error, "strerror", None) or str(error)
        return UsageError(
            f"{file} cannot be used for TLS: {words}",
            Place(str(self.file), 1, 1),
            "A site with certificates is made by: smsl-studio nodes make-site FOLDER.",
        )


class _ClosedSocket(ssl.SSLSocket):
    """A socket that is closed if TLS fails on it. Otherwise nobody would close it."""

    def do_handshake(self, block: bool = False) -> None:
        """Agree on TLS with the other side. OSError if that fails."""
        try:
            super().do_handshake(block)
        except OSError:
            self.close()
            raise


def tls_words(error: ssl.SSLError) -> str:
    """Return why TLS has failed, for people."""
    if isinstance(error, ssl.SSLCertVerificationError):
        return f"its certificate is not accepted: {error.verify_message.rstrip('.')}"
    reason = (error.reason or "").replace("_", " ").lower()
    return f"TLS failed: {reason or error}"
