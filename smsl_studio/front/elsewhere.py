"""Remote sensors: makes a host that receives the samples declared in ``[mqtt]`` of the bindings
file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.project import project_of, real_path, refusal_of_place
from smsl_studio.errors import Place, PluginError, UsageError, did_you_mean
from smsl_studio.front.request import RunRequest
from smsl_studio.host.protocol import Host, SensorInfo
from smsl_studio.host.remote import Remote, WithRemote
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside
from smsl_studio.library.bound import leaf_facts
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.bus import SourceKey
from smsl_studio.monitor.reception import Reception
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.front.sites.site_file import Site
    from smsl_studio.monitor.login import Login

PERIOD, MAX_AGE = 0.1, 0.3
"""The usual time (s) between two samples of a source, and the largest age (s) of a sample if
``_facts`` declares none."""


def with_remote(request: RunRequest, host: Host) -> Host:
    """Return a host that adds remote sensors to ``host``, or ``host`` itself if there are none.

    Broker and site of the request replace those of the bindings file. UsageError if broker and
    remote facts do not fit together. PluginError if the bindings file is not valid.
    """
    blueprint = request.blueprint
    trust = request.trust
    file = (trust.bindings if trust is not None else None) or bindings_beside(blueprint.file)
    table = file.mqtt
    broker, site = request.broker or table.broker, request.site or table.site
    if not table.facts:
        if broker:
            advice = "Write [mqtt.facts] into the bindings file beside the blueprint."
            raise UsageError("a broker is named and no fact is sensed elsewhere", advice=advice)
        return host
    if not broker:
        advice = 'Write broker = "HOST:PORT" into [mqtt] there, or say --broker HOST:PORT.'
        facts = ", ".join(table.facts)
        words = f"no broker is named for what is sensed elsewhere: {facts}"
        raise UsageError(words, file.place("mqtt"), advice)
    sensors = tuple(_sensors(blueprint, file))
    measures = {(one.branch, one.digit, one.name) for one in sensors if one.unit}
    told = None if trust is None else trust.speakers
    speakers = speakers_of(blueprint.file, file) if told is None else told
    reception = Reception(site, table.run, sensors, measures, speakers)
    login = _login(request, file)
    rules = {key: _rule(blueprint, file, key) for key in dict.fromkeys(map(_fact, sensors))}
    values = {key: blueprint[key[0]].alphabet[key[1]] for key in rules}
    # paho is loaded only if a broker is named.
    from smsl_studio.monitor.mqtt import BrokerLink

    line = BrokerLink(broker, reception, login)
    remote = Remote(line, reception, sensors, values, request.seed)
    return WithRemote(
        host, remote, rules, frozenset(rules) if request.world == TABLE else frozenset()
    )


def room_of(blueprint_file: str, file: BindingsFile) -> Site | None:
    """Return the site that the bindings of a blueprint name as its room. None if they name none.

    PluginError if it lies outside the project of the blueprint, or is not valid.
    """
    if not file.mqtt.room:
        return None
    # Few runs have a room or a login.
    from smsl_studio.front.sites.site_file import read_site_file

    project = project_of(blueprint_file)
    path = _beside(blueprint_file, file, "room", project)
    return read_site_file(path, project)


def speakers_of(blueprint_file: str, file: BindingsFile) -> Mapping[SourceKey, str]:
    """Return which node speaks for which source, as the room of the bindings says. Empty without a
    room. PluginError as for ``room_of``."""
    room = room_of(blueprint_file, file)
    return room.speakers if room is not None else {}


def _login(request: RunRequest, file: BindingsFile) -> Login | None:
    """Return the login that the request or the bindings file names. None if there is none."""
    if not (request.login or file.mqtt.login):
        return None
    from smsl_studio.front.sites.login_file import read_login

    if request.login:
        return read_login(Path(request.login))
    source = request.blueprint.file
    return read_login(_beside(source, file, "login", project_of(source)))


def _beside(blueprint_file: str, file: BindingsFile, key: str, project: str) -> Path:
    """Return the real path of a file that the bindings name. PluginError if the blueprint's project
    does not hold it."""
    path = Path(real_path(str(Path(blueprint_file).parent / getattr(file.mqtt, key))))
    refusal = refusal_of_place(str(path), project, f"[mqtt] {key}", (".toml",))
    if refusal is not None:
        raise PluginError(refusal.sentence, file.place(key), refusal.advice)
    return path


def _sensors(blueprint: Blueprint, file: BindingsFile) -> Iterator[SensorInfo]:
    known = {
        fact_text(branch.name, digit): (branch, digit) for branch, digit in leaf_facts(blueprint)
    }
    for key in file.mqtt.facts:
        if key not in known:
            advice = did_you_mean(key, known) or "Facts are written SB/digit, counted from 0."
            words = f"[mqtt.facts] {key!r} is no fact that a sensor could read"
            raise PluginError(words, file.place(key), advice)
        branch, digit = known[key]
        note = branch.fact_note(digit)
        age = (note.max_age if note else None) or MAX_AGE
        aggregation = note.aggregation if note else "single"
        for source in file.mqtt.sources(key):
            if not source:
                raise PluginError(f"[mqtt.facts] {key!r} names a source without a name",
                                  file.place(key), 'Write "SB/digit" = "name".')  # fmt: skip
            unit = _unit(branch, digit, source, file.place(key))
            yield SensorInfo(
                source, branch.name, digit, PERIOD, age, aggregation, remote=True, unit=unit
            )


def _unit(branch: StateBranch, digit: int, source: str, place: Place | None) -> str:
    """Return the unit of a source that predicates read, empty if the fact has none."""
    sense = branch.notes.senses.get(digit)
    if sense is None or sense.fault is not None:
        return ""
    units = sense.units
    if source not in units:
        words = f"[mqtt.facts] names {source!r}, which no predicate of the fact uses"
        advice = did_you_mean(source, units) or f"Its sources are {', '.join(units)}."
        raise PluginError(words, place, advice)
    return units[source].text


def _rule(blueprint: Blueprint, file: BindingsFile, key: FactKey) -> FactRule:
    """Return the rule of a fact as ``_facts`` declares it. Sources that ``_facts`` does not name
    come last."""
    branch, digit = key
    note = blueprint[branch].fact_note(digit)
    sources = file.mqtt.sources(fact_text(branch, digit))
    if note is None:
        return FactRule(sensors=sources)
    names = tuple(dict.fromkeys((*note.sensors, *sources)))
    return FactRule(
        note.aggregation, note.k, note.critical, note.conflict_after, names, note.max_age
    )


def _fact(sensor: SensorInfo) -> FactKey:
    return sensor.branch, sensor.digit
