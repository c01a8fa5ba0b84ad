"""Certificates of a site (X.509): an authority, and a certificate for its broker and each node.

The keys are of the curve P-256, which every TLS library reads. Only the commands that make or look
at a site load this module, because ``cryptography`` takes time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from ipaddress import IPv4Address, IPv6Address, ip_address

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from smsl_studio.errors import SealError

EARLY = timedelta(hours=1)
"""A certificate is valid from so long before its making on, because clocks differ."""
_PLAIN = serialization.NoEncryption()


@dataclass(frozen=True)
class Certified:
    """A certificate and its private key, both as PEM."""

    certificate: bytes
    private: bytes = field(repr=False)


def new_authority(name: str, now: datetime, days: int) -> Certified:
    """Return an authority that signs its own certificate, valid for ``days`` from ``now`` on."""
    key = ec.generate_private_key(ec.SECP256R1())
    subject = _named(name)
    signer = _begun(subject, subject, key, now, days)
    signer = signer.add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
    signer = signer.add_extension(_uses(signs=True), critical=True)
    return _pem(signer.sign(key, hashes.SHA256()), key)


def new_certificate(
    authority: Certified, name: str, now: datetime, days: int, hosts: Sequence[str] = ()
) -> Certified:
    """Return a certificate that the authority has signed.

    ``hosts`` are the names and addresses of a broker. Without them it is the certificate of a node
    or of Studio, which only connects. SealError if the authority cannot be read.
    """
    signed_by, signs = _opened(authority)
    key = ec.generate_private_key(ec.SECP256R1())
    made = _begun(_named(name), signed_by.subject, key, now, days)
    made = made.add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
    made = made.add_extension(_uses(signs=False), critical=True)
    use = ExtendedKeyUsageOID.SERVER_AUTH if hosts else ExtendedKeyUsageOID.CLIENT_AUTH
    made = made.add_extension(x509.ExtendedKeyUsage([use]), critical=False)
    if hosts:
        names = x509.SubjectAlternativeName([_host(one) for one in hosts])
        made = made.add_extension(names, critical=False)
    return _pem(made.sign(signs, hashes.SHA256()), key)


def validity(certificate: bytes) -> tuple[datetime, datetime]:
    """Return from when and until when a certificate (PEM) is valid. SealError if it is none."""
    try:
        found = x509.load_pem_x509_certificate(certificate)
        return found.not_valid_before_utc, found.not_valid_after_utc
    except ValueError:
        raise SealError("it is no certificate", advice="Make the site anew.") from None


def _opened(authority: Certified) -> tuple[x509.Certificate, ec.EllipticCurvePrivateKey]:
    try:
        certificate = x509.load_pem_x509_certificate(authority.certificate)
        private = serialization.load_pem_private_key(authority.private, None)
    except (ValueError, TypeError):
        raise SealError("the authority cannot be read", advice="Make the site anew.") from None
    if not isinstance(private, ec.EllipticCurvePrivateKey):
        raise SealError("the authority has a key of another kind", advice="Make the site anew.")
    return certificate, private


def _begun(
    subject: x509.Name, issuer: x509.Name, key: ec.EllipticCurvePrivateKey, now: datetime, days: int
) -> x509.CertificateBuilder:
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - EARLY)
        .not_valid_after(now + timedelta(days=days))
    )


def _named(name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])


def _host(text: str) -> x509.GeneralName:
    try:
        address: IPv4Address | IPv6Address = ip_address(text)
    except ValueError:
        return x509.DNSName(text)
    return x509.IPAddress(address)


def _uses(*, signs: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=signs,
        crl_sign=signs,
        encipher_only=False,
        decipher_only=False,
    )


def _pem(certificate: x509.Certificate, key: ec.EllipticCurvePrivateKey) -> Certified:
    private = key.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, _PLAIN
    )
    return Certified(certificate.public_bytes(serialization.Encoding.PEM), private)
