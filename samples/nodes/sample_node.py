"""What all sample nodes share: the connection, the messages, and faults to switch on.

A node is a program that speaks for sensors. Each program beside this file plays one: it says what
its sources measure at a moment, and which faults of its own it has. It needs paho-mqtt and nothing
else. ``smsl-studio nodes run FOLDER --broker HOST:PORT`` starts all nodes of a site. A line on
standard input switches a fault on, ``good`` ends all faults, and the end of the input ends the
node. ``docs/room.md`` has the list of faults.
"""

from __future__ import annotations

import argparse
import json
import math
import ssl
import sys
import threading
import time
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from paho.mqtt.client import Client, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

VERSION = 1
SECONDS_KEPT = 1
"""A broker drops a sample that it could not hand on within this time: it would be too old."""
LATE = 1.0
"""Seconds by which the fault ``delay`` is late."""
HOUR = 3600.0
MANY = 200
"""How many messages the fault ``flood`` sends in the place of one."""

Value = float | tuple[float, float, float] | str | None
Plays = Callable[[float, frozenset[str]], dict[str, Value]]
"""What the sources of a node measure: from the time (s) and the faults that are on. A source that
is left out is not read, as a tag out of reach."""

FAULTS = {
    "silent": "it is connected and sends no samples",
    "off": "it has no power: its connection breaks",
    "stuck": "it always sends what it measured when this began",
    "loss": "every second sample is lost",
    "delay": "its samples arrive a second late",
    "twice": "it sends each sample twice",
    "disorder": "of two samples it sends the newer one first",
    "clock": "its clock goes back an hour",
    "restart": "it starts again, with a new boot",
    "doubt": "it says that its readings are uncertain",
    "nan": "it sends numbers that are none",
    "wild": "it sends numbers far outside its range",
    "text": "it sends words for numbers",
    "flood": "it sends two hundred samples for one",
    "retain": "it asks the broker to keep its samples",
    "name": "it says that it is another node",
    "foreign": "it also speaks on the topics of another node",
}


@dataclass
class Asked:
    """What the command line of a node says."""

    broker: str
    site: str
    run: str
    node: str
    rate: float
    login: str
    sources: dict[str, list[str]]
    """The topics of each source, without their beginning."""
    victim: str
    foreign: list[str]


class SampleNode:
    """A program that speaks for sensors: birth, will, and samples with boot and sequence."""

    def __init__(self, asked: Asked, plays: Plays, own: dict[str, str]) -> None:
        self.faults: set[str] = set()
        self._own = own
        self._asked, self._plays = asked, plays
        self._boot = time.time_ns() // 1_000_000
        self._sequence = 0
        self._began = time.monotonic()
        self._clock = 0.0
        self._kept: dict[str, Value] = {}
        self._ended = threading.Event()
        self._late: list[tuple[float, str, dict[str, object]]] = []
        self._held: tuple[str, dict[str, object]] | None = None
        self._connect()

    def _connect(self) -> None:
        asked = self._asked
        self._status = f"smsl/1/{_level(asked.site)}/node/{_level(asked.node)}/status"
        self._client = client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
        client.reconnect_delay_set(1, 2)
        client.will_set(self._status, self._said("gone"), qos=1, retain=True)
        client.on_connect = self._connected
        if asked.login:
            log_in(client, Path(asked.login))
        host, _, port = asked.broker.rpartition(":")
        if not host:
            host, port = asked.broker, "8883" if asked.login else "1883"
        client.connect(host.strip("[]"), int(port), keepalive=2)
        client.loop_start()

    def _connected(
        self, client: Client, data: object, flags: object, code: object, _: object
    ) -> None:
        if getattr(code, "is_failure", False):
            print(f"refused: {code}", flush=True)
            return
        client.publish(self._status, self._said("alive"), qos=1, retain=True)
        print(f"connected to {self._asked.broker}", flush=True)

    def speak(self) -> None:
        """Tell what is measured, at the node's rate, until the node is ended."""
        while not self._ended.wait(1 / self._asked.rate):
            if "off" not in self.faults and "silent" not in self.faults:
                self.tell()

    def tell(self) -> None:
        """Tell what is measured now, once."""
        now = time.monotonic()
        values = self._plays(now - self._began, frozenset(self.faults))
        if "stuck" in self.faults:
            values = self._kept = self._kept or values
        else:
            self._kept = {}
        for source, value in values.items():
            self._sequence += 1
            if "loss" in self.faults and self._sequence % 2:
                continue
            message = self._message(value)
            for topic in self._asked.sources.get(source, ()):
                self._pass(topic, message, now)
        for at, topic, message in [one for one in self._late if one[0] <= now]:
            self._late.remove((at, topic, message))
            self._send(topic, message)

    def switch(self, fault: str) -> None:
        """Switch a fault on, or all of them off with ``good``."""
        if fault == "good":
            was_off = "off" in self.faults
            self.faults.clear()
            self._clock, self._held = 0.0, None
            if was_off:
                self._boot = time.time_ns() // 1_000_000
                self._connect()
        elif fault not in FAULTS and fault not in self._own:
            print(f"no fault: {fault}; there are {', '.join((*FAULTS, *self._own))}", flush=True)
            return
        elif fault == "restart":
            self._boot, self._sequence = time.time_ns() // 1_000_000, 0
            self._client.publish(self._status, self._said("alive"), qos=1, retain=True)
        else:
            self.faults.add(fault)
            self._clock = -HOUR if "clock" in self.faults else 0.0
            if fault == "off":
                self._break()
        print(f"fault: {fault}", flush=True)

    def end(self) -> None:
        """Say that it goes, and go."""
        self._ended.set()
        if "off" not in self.faults:
            parting = self._client.publish(self._status, self._said("gone"), qos=1, retain=True)
            if self._client.is_connected():
                parting.wait_for_publish(1.0)
            self._client.disconnect()
            self._client.loop_stop()

    def _break(self) -> None:
        """End the connection without a word, so that the broker tells the will."""
        self._client.loop_stop()
        left = self._client.socket()
        if left is not None:
            left.close()

    def _message(self, value: Value) -> dict[str, object]:
        faults = self.faults
        if value is not None and "wild" in faults:
            value = 1e9
        if value is not None and "text" in faults:
            value = "plenty"
        if value is not None and "nan" in faults:
            value = math.nan
        quality = "bad" if value is None else "uncertain" if "doubt" in faults else "good"
        return {
            "version": VERSION,
            "node": self._asked.victim if "name" in faults else self._asked.node,
            "boot": self._boot,
            "sequence": self._sequence,
            "time": time.monotonic() + self._clock,
            "value": value,
            "quality": quality,
            "reason": "" if value is not None else "the sensor has no valid reading",
        }

    def _pass(self, topic: str, message: dict[str, object], now: float) -> None:
        faults = self.faults
        if "delay" in faults:
            self._late.append((now + LATE, topic, message))
            return
        if "disorder" in faults:
            held, self._held = self._held, (topic, message) if self._held is None else None
            if held is None:
                return
            self._send(topic, message)
            self._send(*held)
            return
        self._send(topic, message)
        for _ in range(MANY if "flood" in faults else 1 if "twice" in faults else 0):
            if "flood" in faults:
                self._sequence += 1
                message = {**message, "sequence": self._sequence}
            self._send(topic, message)
        if "foreign" in faults:
            for other in self._asked.foreign:
                self._send(other, message)

    def _send(self, topic: str, message: dict[str, object]) -> None:
        # What could not be sent must not be sent later: nobody would believe it.
        if not self._client.is_connected():
            return
        kept = Properties(PacketTypes.PUBLISH)
        kept.MessageExpiryInterval = SECONDS_KEPT
        asked = self._asked
        whole = f"smsl/1/{_level(asked.site)}/run/{_level(asked.run)}/fact/{topic}"
        keeps = "retain" in self.faults
        self._client.publish(whole, json.dumps(message), qos=1, retain=keeps, properties=kept)

    def _said(self, state: str) -> str:
        return json.dumps({"version": VERSION, "boot": self._boot, "state": state})


def log_in(client: Client, login: Path) -> None:
    """Use the authority, and the certificate or the password, that a login file names."""
    said = tomllib.loads(login.read_text("utf-8"))
    beside = login.parent
    context = ssl.create_default_context(cafile=str(beside / said["authority"]))
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    if "certificate" in said:
        context.load_cert_chain(str(beside / said["certificate"]), str(beside / said["key"]))
    else:
        client.username_pw_set(said["user"], (beside / said["password"]).read_text("utf-8").strip())
    client.tls_set_context(context)


def play(plays: Plays, own: dict[str, str], words: Sequence[str] | None = None) -> int:
    """Be a node until the input ends. ``own`` are the faults of this kind of node."""
    asked, faults = _asked(words)
    try:
        node = SampleNode(asked, plays, own)
    except (OSError, ValueError, KeyError) as error:
        print(f"no connection to {asked.broker}: {error}", file=sys.stderr, flush=True)
        return 1
    for fault in faults:
        node.switch(fault)
    threading.Thread(target=node.speak, daemon=True).start()
    try:
        for line in sys.stdin:
            if line.strip():
                node.switch(line.strip())
    except KeyboardInterrupt:
        pass
    node.end()
    return 0


def _asked(words: Sequence[str] | None) -> tuple[Asked, list[str]]:
    parser = argparse.ArgumentParser()
    parser.add_argument("--broker", default="localhost:1883", metavar="HOST[:PORT]")
    parser.add_argument("--site", default="local")
    parser.add_argument("--run", default="main")
    parser.add_argument("--node", required=True)
    parser.add_argument("--rate", type=float, default=10.0, metavar="HZ")
    parser.add_argument("--login", default="", metavar="FILE", help="certificate or password")
    parser.add_argument("--source", action="append", default=[], metavar="SB/DIGIT:SOURCE")
    parser.add_argument("--victim", default="another", help="whose name the fault name steals")
    parser.add_argument("--foreign", action="append", default=[], metavar="SB/DIGIT:SOURCE")
    parser.add_argument("--fault", action="append", default=[], help="on from the beginning")
    said = parser.parse_args(words)
    sources: dict[str, list[str]] = {}
    for text in said.source:
        sources.setdefault(text.partition(":")[2], []).append(_topic(text))
    foreign = [_topic(text) for text in said.foreign]
    asked = Asked(said.broker, said.site, said.run, said.node, said.rate, said.login, sources,
                  said.victim, foreign)  # fmt: skip
    return asked, said.fault


def _topic(text: str) -> str:
    fact, _, source = text.partition(":")
    branch, _, digit = fact.rpartition("/")
    return f"{_level(branch)}/{digit}/{_level(source)}"


def _level(name: str) -> str:
    """A name as one level of a topic: percent-encoded, so that ``/``, ``+`` and ``#`` are none."""
    return quote(name, safe="")
