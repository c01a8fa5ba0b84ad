"""A sensor node in one file: it tells facts over MQTT 5, and needs paho-mqtt and nothing else.

::

    python samples/nodes/fact_node.py --site lab --fact SB1/0:camera=1 --fact SB1/2:scale=0

tells at 10 Hz that camera reads 1 for the first fact of SB1, and scale 0 for the third (digits
count from 0). A line typed in changes what a source reads: ``camera 0``; ``camera ?`` says that it
has no valid reading, and ``camera -`` keeps it silent, which is what a lost sensor does. The end of
the input ends the node. ``docs/monitoring.md`` has the topics and messages that it sends.
"""

from __future__ import annotations

import argparse
import json
import sys
import threading
import time
from dataclasses import dataclass
from urllib.parse import quote

from paho.mqtt.client import Client, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

VERSION = 1
SECONDS_KEPT = 1
"""A broker drops a fact that it could not hand on within this time: it would be too old."""


@dataclass
class Fact:
    """One source of one fact; ``silent`` is one that says nothing at all."""

    branch: str
    digit: int
    source: str
    value: str | None
    silent: bool = False


class Node:
    """A program that speaks for sensors: birth, will, and samples with boot and sequence."""

    def __init__(self, site: str, run: str, name: str, facts: list[Fact], rate: float) -> None:
        self.facts = facts
        self._name, self._rate = name, rate
        # Grows with every start, which is all that is asked of it.
        self._boot = time.time_ns() // 1_000_000
        self._sequence = 0
        self._status = f"smsl/1/{_level(site)}/node/{_level(name)}/status"
        self._fact = f"smsl/1/{_level(site)}/run/{_level(run)}/fact"
        self._client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
        self._client.will_set(self._status, self._said("gone"), qos=1, retain=True)
        self._client.on_connect = lambda client, *_: client.publish(
            self._status, self._said("alive"), qos=1, retain=True
        )
        self._ended = threading.Event()

    def connect(self, host: str, port: int) -> None:
        """Connect, and keep connected."""
        self._client.connect(host, port, keepalive=2)
        self._client.loop_start()

    def speak(self) -> None:
        """Tell every fact at the node's rate until the node is ended."""
        kept = Properties(PacketTypes.PUBLISH)
        kept.MessageExpiryInterval = SECONDS_KEPT
        while not self._ended.wait(1 / self._rate):
            # What could not be sent must not be sent later: nobody would believe it.
            if self._client.is_connected():
                for fact in self.facts:
                    if not fact.silent:
                        self._tell(fact, kept)

    def end(self) -> None:
        """Say that it goes, and go."""
        self._ended.set()
        parting = self._client.publish(self._status, self._said("gone"), qos=1, retain=True)
        if self._client.is_connected():
            parting.wait_for_publish(1.0)
        self._client.disconnect()
        self._client.loop_stop()

    def _tell(self, fact: Fact, kept: Properties) -> None:
        self._sequence += 1
        message = {
            "version": VERSION,
            "node": self._name,
            "boot": self._boot,
            "sequence": self._sequence,
            "time": time.monotonic(),
            "value": fact.value,
            "quality": "good" if fact.value is not None else "bad",
            "reason": "" if fact.value is not None else "the sensor has no valid reading",
        }
        topic = f"{self._fact}/{_level(fact.branch)}/{fact.digit}/{_level(fact.source)}"
        self._client.publish(topic, json.dumps(message), qos=1, properties=kept)

    def _said(self, state: str) -> str:
        return json.dumps({"version": VERSION, "boot": self._boot, "state": state})


def main() -> int:
    """Speak until the input ends."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--broker", default="localhost:1883", metavar="HOST[:PORT]")
    parser.add_argument("--site", default="local")
    parser.add_argument("--run", default="main")
    parser.add_argument("--node", default="bench")
    parser.add_argument("--rate", type=float, default=10.0, metavar="HZ")
    parser.add_argument(
        "--fact", action="append", required=True, type=_fact, metavar="SB/DIGIT:SOURCE=VALUE"
    )
    asked = parser.parse_args()
    host, _, port = asked.broker.partition(":")
    node = Node(asked.site, asked.run, asked.node, asked.fact, asked.rate)
    try:
        node.connect(host, int(port or 1883))
    except OSError as error:
        print(f"there is no broker at {asked.broker}: {error}", file=sys.stderr)
        return 1
    threading.Thread(target=node.speak, daemon=True).start()
    try:
        for line in sys.stdin:
            obey(node.facts, line)
    except KeyboardInterrupt:
        pass
    node.end()
    return 0


def obey(facts: list[Fact], line: str) -> None:
    """Change what a source reads: ``SOURCE VALUE``, ``SOURCE ?`` or ``SOURCE -``."""
    source, _, value = line.strip().rpartition(" ")
    met = [fact for fact in facts if fact.source == source]
    if not met:
        names = ", ".join(fact.source for fact in facts)
        print(f"write SOURCE VALUE, with one of {names}", file=sys.stderr)
    for fact in met:
        fact.silent = value == "-"
        fact.value = None if value == "?" else value


def _fact(text: str) -> Fact:
    where, colon, said = text.partition(":")
    branch, slash, digit = where.rpartition("/")
    source, _, value = said.partition("=")
    if not (colon and slash and branch and digit.isdecimal() and source):
        raise argparse.ArgumentTypeError(f"{text!r} is not SB/DIGIT:SOURCE=VALUE")
    return Fact(branch, int(digit), source, value if value not in ("", "?") else None)


def _level(name: str) -> str:
    """A name as one level of a topic: percent-encoded, so that ``/``, ``+`` and ``#`` are none."""
    return quote(name, safe="")


if __name__ == "__main__":
    sys.exit(main())
