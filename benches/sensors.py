"""Remote sensors: frozen nodes and brokers, floods, and the cost of receiving a message.

A run by hand has the pace of the window, and its first fact comes over its own mosquitto. A node or
the broker is frozen (SIGSTOP) at a random moment; ``beyond`` is the wall time from the fact's
maximum age until the fact is unknown. An operation is asked for then: nothing may begin. In a
flood, processes send as many messages of one source as the broker takes.
"""

from __future__ import annotations

import json
import resource
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import tracemalloc
from collections.abc import Iterator
from pathlib import Path
from random import Random
from shutil import copy

from benches.row import Row, median_ms
from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.monitor.message import fact_payload
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.sample import Sample
from smsl_studio.monitor.topics import FactTopic
from smsl_studio.runlog.events import OperationStarted
from smsl_studio.shipped import samples_dir
from tests.monitor.broker import Broker, Node

MAX_AGE = 0.3
BOUND = "at most 50 ms"
TRIES, ALL_TRIES = 10, 100
MESSAGES = 100_000
FLOOD = 3.0
"""Seconds."""
PACE = 1 / 240
OPERATION = Address("SB1", "State_aa", "Op_1b")

FLOODER = """
import sys
from paho.mqtt.client import Client, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion
client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
client.connect("127.0.0.1", int(sys.argv[1]))
client.loop_start()
sequence = 0
while True:
    sequence += 1
    said = '{"version":1,"node":"flood","boot":1,"sequence":%d,"time":0,"value":"a"}' % sequence
    client.publish(sys.argv[2], said).wait_for_publish()
"""


def rows() -> Iterator[Row]:
    """Ten tries of each."""
    return _rows(TRIES)


def all_rows() -> Iterator[Row]:
    """A hundred tries of each."""
    return _rows(ALL_TRIES)


def _rows(tries: int) -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as name:
        bench = _Bench(Path(name))
        try:
            for who in ("node", "broker"):
                beyond = bench.freeze(who, tries)
                half = statistics.median(beyond)
                words = f"frozen {who}, {tries} tries: unknown beyond {MAX_AGE * 1000:.0f} ms"
                yield Row(f"{words} (median {half:.0f})", max(beyond), "ms, worst", (), BOUND)
            yield Row(f"{2 * tries} operations asked for on an unknown fact", bench.begun,
                      "begun", bound="0")  # fmt: skip
            for source in ("somebody nobody declared", "a declared source"):
                yield from bench.flood(source)
        finally:
            bench.close()
    yield from _reception()


class _Bench:
    """A broker, a node, and a run that receives the node's samples."""

    def __init__(self, folder: Path) -> None:
        copy(samples_dir() / "hanoi-2.json", folder)
        text = '[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n"SB1/1" = "scale"\n'
        (folder / "hanoi-2.toml").write_text(text, "utf-8")
        self.begun = 0
        self._chance = Random(1)
        blueprint = read(folder / "hanoi-2.json")
        self._broker = Broker(folder)
        self._node = Node(self._broker, "SB1/0:eye=a", "SB1/1:scale=a")
        self._run: Dispatcher = front.open_run(
            blueprint, "table", host="local", automatic=False, broker=self._broker.address
        )
        self._run.open()

    def close(self) -> None:
        self._run.close()
        self._node.kill()
        self._broker.kill()

    def freeze(self, who: str, tries: int) -> list[float]:
        """Return the ms from the largest age of the fact until it is unknown, for each try."""
        frozen: Node | Broker = self._node if who == "node" else self._broker
        beyond = []
        for _ in range(tries):
            self._until_value("a")
            self._go_on(0.2 + self._chance.random() * 0.2)
            began = time.monotonic()
            frozen.freeze()
            self._until_value(None)
            beyond.append((time.monotonic() - began - MAX_AGE) * 1000)
            self._run.ask(OPERATION)
            events = [*self._run.tick(), *self._run.tick()]
            self.begun += sum(isinstance(event, OperationStarted) for event in events)
            frozen.thaw()
        self._until_value("a")
        return beyond

    def flood(self, source: str) -> Iterator[Row]:
        """Measure the effect of a flood on a run whose first fact has a normal node."""
        flooding = "scale" if source.startswith("a ") else "nobody"
        topic = str(FactTopic("lab", "main", "SB1", 1, flooding))
        command = [sys.executable, "-c", FLOODER, str(self._broker.port), topic]
        opened = self._run.opened
        assert opened is not None
        assert opened.remote is not None
        before, memory = opened.remote.view().received.messages, _resident()
        flooders = [subprocess.Popen(command) for _ in range(2)]
        try:
            ticks, unknown, slowest = self._go_on(FLOOD)
        finally:
            for flooder in flooders:
                flooder.kill()
                flooder.wait()
        rate = (opened.remote.view().received.messages - before) / FLOOD
        words = f"{source} floods, {rate:,.0f} messages/s over the broker"
        yield Row(f"{words}: the slowest tick", slowest * 1000, "ms")
        yield Row(f"{words}: of {ticks} ticks the other source unknown in", unknown, "ticks",
                  bound="0")  # fmt: skip
        yield Row(f"{words}: memory", _resident() - memory, "MB more", bound="bounded")

    def _go_on(self, seconds: float) -> tuple[int, int, float]:
        """Tick for so long; how often, in how many the fact was unknown, the slowest tick (s)."""
        ticks, unknown, slowest, ends = 0, 0, 0.0, time.monotonic() + seconds
        while time.monotonic() < ends:
            began = time.monotonic()
            self._run.tick()
            slowest = max(slowest, time.monotonic() - began)
            ticks += 1
            unknown += self._value is None
            time.sleep(PACE)
        return ticks, unknown, slowest

    def _until_value(self, value: str | None) -> None:
        while self._value != value:
            self._run.tick()
            time.sleep(PACE)

    @property
    def _value(self) -> str | None:
        return self._run.status.scene.readings["SB1", 0].value


def _reception() -> Iterator[Row]:
    """100,000 messages of one source in this process, beside reading their JSON alone."""
    sensors = [SensorInfo("eye", "SB1", 0, 0.1, MAX_AGE, remote=True)]
    topic = str(FactTopic("lab", "main", "SB1", 0, "eye"))
    payloads = [fact_payload("n", Sample("SB1", 0, "eye", "a", 0.0, n)) for n in range(MESSAGES)]
    reception = Reception("lab", "main", sensors)

    def receive() -> None:
        for payload in payloads:
            reception.receive(topic, payload, False, 0.0)

    loads = median_ms(lambda: [json.loads(one) for one in payloads], 3)
    ours = median_ms(receive, 3)
    yield Row(f"receive {MESSAGES:,} messages of one source", ours, "ms", (("json.loads", loads),),
              "100,000 a second")  # fmt: skip
    tracemalloc.start()
    receive()
    kept, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    waiting = len(reception.take())
    yield Row(f"kept of {MESSAGES:,} messages ({waiting} waits)", kept / 1024, "kB", (), "bounded")
    yield _beside()


def _beside() -> Row:
    """A thread floods the bus of a run while it ticks."""
    blueprint = read(samples_dir() / "hanoi-2.json")
    run = front.open_run(blueprint, "table", host="local", automatic=False)
    run.open()
    driver = run._driver
    assert driver is not None
    bus, ended, sent = driver.run.senses.bus, threading.Event(), [0]
    samples = [Sample("SB1", 0, "nobody", "b", 0.0, n) for n in range(100)]

    def speak() -> None:
        while not ended.is_set():
            bus.publish(samples)
            sent[0] += len(samples)

    thread = threading.Thread(target=speak)
    thread.start()
    slowest, unknown, began = 0.0, 0, time.monotonic()
    while time.monotonic() - began < 2.0:
        at = time.monotonic()
        run.tick()
        slowest = max(slowest, time.monotonic() - at)
        unknown += any(one.value is None for one in run.status.scene.readings.values())
    ended.set()
    thread.join()
    run.close()
    rate = sent[0] / 2.0
    words = f"a thread floods the bus, {rate:,.0f} samples/s, {unknown} facts unknown: slowest tick"
    return Row(words, slowest * 1000, "ms")


def _resident() -> float:
    """Return the peak of memory so far, in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
