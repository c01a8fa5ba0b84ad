"""What one person signs: an in-toto Statement about every file of a blueprint.

Reading is strict. A statement is refused if it has an unknown member, or if its bytes differ from
those that Studio writes for the same values. Every file's content must have the digests that the
statement names, so that a record cannot contradict itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    ValidationError,
    model_serializer,
)

from smsl_studio.blueprint.digests import Digests, digests_of
from smsl_studio.errors import SealError, StudioError
from smsl_studio.inspection.approval.times import read_time
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.seal.strict_json import read_strictly

Json = Any
STATEMENT: Literal["https://in-toto.io/Statement/v1"] = "https://in-toto.io/Statement/v1"
PREDICATE: Literal["urn:smsl-studio:inspection:v1"] = "urn:smsl-studio:inspection:v1"
PAYLOAD_TYPE = "application/vnd.in-toto+json"
APPROVED, CONDITIONS, REJECTED = "approved", "conditions", "rejected"
AUTOMATIC = "automatic"
"""The role of keys with which programs sign. It never counts as a person."""
RECORDER = "recorder"
"""The role of keys with which computers sign the heads of logs. They approve nothing."""

MEANINGS: Mapping[str, str] = MappingProxyType(
    {
        APPROVED: "I have inspected this blueprint as these digests name it, and I approve it.",
        CONDITIONS: "I have inspected this blueprint as these digests name it. I approve it "
        "if the conditions are met.",
        REJECTED: "I have inspected this blueprint as these digests name it, and I reject it.",
    }
)
"""For each verdict, a sentence that tells the signer what the signature means."""

Hex = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Text = Annotated[str, Field(max_length=10_000)]


class _Signed(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class SignedDigests(_Signed):
    """The three digests of a file (see ``blueprint.digests``)."""

    behaviour: Hex
    meaning: Hex
    closure: Hex

    def are(self, found: Digests) -> bool:
        """Whether the blueprint has these digests."""
        return (self.behaviour, self.meaning, self.closure) == (
            found.behaviour,
            found.meaning,
            found.closure,
        )


class SignedFile(_Signed):
    """A file of the blueprint or an import. Its name is relative to the first file's folder."""

    name: Text
    digest: SignedDigests


class SignedScore(_Signed):
    """How many of so many seeded faults a rule found in files without faults."""

    found: int
    of: int


class SignedRule(_Signed):
    """A rule that was checked: its version, the SHA-256 of its code, and its result.

    ``score`` says what the rule is worth (see ``rule_scores``). Older records have none.
    """

    id: Text
    version: Text
    code: Hex
    result: Literal["passed", "noted", "warned", "failed"]
    score: SignedScore | None = None

    @model_serializer(mode="wrap")
    def _written(self, write: SerializerFunctionWrapHandler) -> Json:
        values = write(self)
        if self.score is None:
            del values["score"]
        return values


class SignedProperty(_Signed):
    """A hazard or property, and what the proof showed about it."""

    name: Text
    kind: Text
    severity: Text
    verdict: Text
    configurations: int | None


class SignedFinding(_Signed):
    """A finding of the check, at the time of the signature."""

    rule: Text
    severity: Text
    address: Text
    message: str


class Disposition(_Signed):
    """What the signer says about a warning."""

    rule: Text
    address: Text
    text: Text


class SignedFunction(_Signed):
    """A bound function or sensor: its plugin, the plugin's version, the SHA-256 of its code."""

    function: Text
    plugin: Text
    version: Text
    code: Hex


class WorldCode(_Signed):
    """The code that is bound in a world. ``bindings`` is the SHA-256 of all bindings."""

    hardware: bool
    functions: list[SignedFunction]
    bindings: Hex


class InspectionOptions(_Signed):
    """The options with which the blueprint was checked."""

    limit: Annotated[int, Field(ge=1)] | None
    with_failures: bool
    recoverability: bool
    rules: list[Text] | None


class Predicate(_Signed):
    """What the signer has looked at, and what the signer decides about it."""

    rules: list[SignedRule]
    properties: list[SignedProperty]
    findings: list[SignedFinding]
    dispositions: list[Disposition]
    verdict: Literal["approved", "conditions", "rejected"]
    conditions: list[Text]
    met: list[Text]
    worlds: dict[str, WorldCode]
    looked_at: list[Text]
    relies_on: list[SignedFile]
    options: InspectionOptions
    person: Annotated[str, Field(min_length=1, max_length=1000)]
    role: Annotated[str, Field(min_length=1, max_length=1000)]
    meaning: Text
    time: Text
    expires: Text | None
    content: dict[str, dict[str, Json]]
    follows: Hex | None


class Statement(_Signed):
    """An in-toto Statement v1. The first subject is the file that was approved."""

    type_: Literal["https://in-toto.io/Statement/v1"] = Field(alias="_type")
    subject: Annotated[list[SignedFile], Field(min_length=1, max_length=1000)]
    predicateType: Literal["urn:smsl-studio:inspection:v1"]  # noqa: N815 -- the word of in-toto
    predicate: Predicate

    @property
    def digests(self) -> SignedDigests:
        """The digests of the file that was approved."""
        return self.subject[0].digest

    @property
    def time(self) -> datetime:
        """The moment of the signature."""
        return read_time(self.predicate.time)

    @property
    def expires(self) -> datetime | None:
        """The time at which the approval ends; None if it does not end."""
        return None if self.predicate.expires is None else read_time(self.predicate.expires)

    def payload(self) -> bytes:
        """Return the canonical bytes that are signed."""
        return canonical(self.model_dump(by_alias=True))


def statement_of(subject: list[SignedFile], predicate: Predicate) -> Statement:
    """Return the statement about some files."""
    return Statement(_type=STATEMENT, subject=subject, predicateType=PREDICATE, predicate=predicate)


def payload_digest(payload: bytes) -> str:
    """Return the SHA-256 of a signed payload, which is the name of the record."""
    return sha256_hex(payload)


def read_statement(payload: bytes) -> Statement:
    """Return the statement in a payload. SealError if Studio would write it differently."""
    values = read_strictly(payload, "the payload")
    try:
        found = Statement.model_validate(values)
        _check_times(found)
        if found.payload() != payload:
            raise SealError("the payload is not written as Studio writes it")
        _check_content(found)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        where = ".".join(str(part) for part in fault["loc"])
        raise SealError(f"the payload: {where[:200]}: {fault['msg']}") from None
    except RecursionError:
        raise SealError("the payload is nested too deeply") from None
    except SealError:
        raise
    except StudioError as error:
        raise SealError(f"the payload: {error.sentence}") from None
    return found


def _check_times(found: Statement) -> None:
    try:
        _ = found.time, found.expires
    except ValueError as error:
        raise SealError(f"the payload: {error}") from None


def _check_content(found: Statement) -> None:
    names = [one.name for one in found.subject]
    content = found.predicate.content
    if len(set(names)) < len(names) or set(names) != set(content):
        raise SealError("the payload has not one content for each of its files")
    for one in found.subject:
        if set(content[one.name]) != {"behaviour", "meaning", "imported", "missing"}:
            raise SealError(f"the content of {one.name} has other parts than Studio writes")
        if not _is_listed(content[one.name]) or not one.digest.are(digests_of(content[one.name])):
            raise SealError(f"the content of {one.name} has other digests than are named")


def _is_listed(content: Mapping[str, Json]) -> bool:
    return all(isinstance(part, list) for part in content.values()) and bool(content["imported"])
