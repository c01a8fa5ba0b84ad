"""What the HIM answers: devices that are there, and what the procedure needs of them; as data and
as ``him.toml``."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from smsl_studio.generate.text.steps import Short, Source, Words

Json = Any
_MOST = 400


def _as_text(raw: Json) -> Json:
    """Return the number of a step as a text: people also write ``[1, 2.1]``."""
    return str(raw) if type(raw) in (int, float) else raw


_StepNumber = Annotated[Words, BeforeValidator(_as_text)]


class _PartOfEquipment(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Device(_PartOfEquipment):
    """A thing of the hardware list."""

    name: Words
    kind: Literal["device", "sensor"] = "device"
    sources: Annotated[tuple[Source, ...], Field(max_length=10)] = ()


class Need(_PartOfEquipment):
    """A thing that the procedure needs. ``steps`` are the numbers of the steps that need it.
    ``met_by`` is the name of a device, empty if it is missing."""

    name: Words
    kind: Literal["device", "sensor"] = "device"
    steps: Annotated[tuple[_StepNumber, ...], Field(max_length=_MOST)] = ()
    met_by: Short = ""
    sources: Annotated[tuple[Source, ...], Field(max_length=10)] = ()


class NeededEquipment(_PartOfEquipment):
    """The answer of the HIM."""

    devices: Annotated[tuple[Device, ...], Field(max_length=_MOST)] = ()
    needs: Annotated[tuple[Need, ...], Field(max_length=_MOST)] = ()

    @property
    def missing(self) -> tuple[str, ...]:
        """The names of the needs that nothing meets."""
        return tuple(need.name for need in self.needs if not need.met_by)

    def sensors(self) -> dict[str, list[str]]:
        """Return, by the number of a step, the sensors that it names."""
        kinds = {one.name: one.kind for one in self.devices}
        found: dict[str, list[str]] = {}
        for need in self.needs:
            if kinds.get(need.met_by) == "sensor":
                for step in need.steps:
                    found.setdefault(step, []).append(need.met_by)
        return found


class PluginOffer(_PartOfEquipment):
    """What an installed plugin offers."""

    plugin: str
    worlds: tuple[str, ...] = ()
    operations: tuple[str, ...] = ()
    sensors: tuple[str, ...] = ()


def faults_of(equipment: NeededEquipment) -> list[str]:
    """Return what the schema cannot say: a need that is met by a device nobody listed."""
    known = {one.name for one in equipment.devices}
    return [
        f"{need.name} is met by {need.met_by!r}, which is no device of the list"
        for need in equipment.needs
        if need.met_by and need.met_by not in known
    ]


def equipment_page(
    equipment: NeededEquipment, offers: Iterable[PluginOffer], origin: Mapping[str, Json]
) -> str:
    """Return ``him.toml``. ``origin`` says how it was made."""
    lines = ["[_origin]", *_pairs(dict(origin))]
    for device in equipment.devices:
        lines += ["", "[[device]]", *_pairs({"name": device.name, "kind": device.kind})]
        lines += _sources(device.sources)
    for need in equipment.needs:
        met = {"met_by": need.met_by} if need.met_by else {}
        status = "met" if need.met_by else "missing"
        said = {"name": need.name, "kind": need.kind, "status": status, **met}
        lines += ["", "[[needed]]", *_pairs(said), f"steps = {_text(list(need.steps))}"]
        lines += _sources(need.sources)
    for offer in offers:
        lines += ["", "[[offered]]", f"plugin = {_text(offer.plugin)}"]
        lines += [f"{key} = {_text(list(getattr(offer, key)))}"
                  for key in ("worlds", "operations", "sensors")]  # fmt: skip
    return "\n".join(lines) + "\n"


def read_equipment_page(text: str) -> Json:
    """Return the plain values of an answer in ``him.toml``. ValueError if it is no TOML."""
    raw = tomllib.loads(text)
    needs = [
        {key: one for key, one in need.items() if key != "status"}
        if isinstance(need, dict)
        else need
        for need in _list(raw.get("needed"))
    ]
    odd = {key: raw[key] for key in raw if key not in ("_origin", "offered", "device", "needed")}
    return {"devices": _list(raw.get("device")), "needs": needs, **odd}


def _list(raw: Json) -> Json:
    return [] if raw is None else raw


def _pairs(values: Mapping[str, Json]) -> Iterator[str]:
    for key, value in values.items():
        yield f"{key} = {_text(value)}"


def _sources(sources: Iterable[Source]) -> Iterator[str]:
    told = ["{ " + ", ".join(_pairs(source.citation.as_json())) + " }" for source in sources]
    if told:
        yield f"sources = [{', '.join(told)}]"


def _text(value: Json) -> str:
    """Return a text, a number or a list of texts in TOML, which has the escapes of JSON."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
