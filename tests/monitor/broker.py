"""Debian's mosquitto on a free port of this machine, and programs that speak to it."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from paho.mqtt.client import Client, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion

from smsl_studio.shipped import samples_dir

NODE = samples_dir() / "nodes" / "fact_node.py"
PATIENCE = 20.0
"""Seconds after which what did not happen never will."""


MAX_AGE = 1.0
"""Seconds after which a fact of ``with_ages`` is too old."""


def until(condition: Callable[[], bool], what: str) -> None:
    """Wait for something that must happen sooner or later."""
    ends = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < ends, f"never: {what}"
        time.sleep(0.005)


def with_ages(sample: str, folder: Path) -> Path:
    """A copy of a sample in which facts may be older than usual: test machines are busy."""
    values = json.loads((samples_dir() / f"{sample}.json").read_text("utf-8"))
    for sb in values.values():
        sb["_facts"] = {str(digit): {"max_age": MAX_AGE} for digit in range(2)}
    path = folder / f"{sample}.json"
    path.write_text(json.dumps(values), "utf-8")
    return path


class Broker:
    """A mosquitto of one's own. ``freeze`` and ``thaw`` are SIGSTOP and SIGCONT.

    ``config`` is its configuration; without one it listens on ``port`` to anybody.
    """

    def __init__(self, folder: Path, port: int = 0, config: Path | None = None) -> None:
        self.port = port or free_port()
        self.folder = folder
        self._config = config or folder / "mosquitto.conf"
        if config is None:
            text = f"listener {self.port} 127.0.0.1\nallow_anonymous true\n"
            self._config.write_text(text, "utf-8")
        self._process: subprocess.Popen[bytes] | None = None
        self.start()

    @property
    def address(self) -> str:
        return f"127.0.0.1:{self.port}"

    def start(self) -> None:
        """Start it; a broker that is not installed is a failure that says so."""
        program = shutil.which("mosquitto", path=f"{os.environ.get('PATH', '')}:/usr/sbin")
        assert program, "mosquitto is not installed; ./dev setup installs it (apt: mosquitto)"
        config = self._config
        log = (self.folder / "mosquitto.log").open("ab")
        with log:
            self._process = subprocess.Popen([program, "-c", str(config)], stdout=log, stderr=log)
        until(self._answers, "mosquitto listens")

    def freeze(self) -> None:
        self._send(signal.SIGSTOP)

    def thaw(self) -> None:
        self._send(signal.SIGCONT)

    def kill(self) -> None:
        """kill -9."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()

    def _send(self, number: signal.Signals) -> None:
        assert self._process is not None
        self._process.send_signal(number)

    def _answers(self) -> bool:
        assert self._process is not None
        assert self._process.poll() is None, "mosquitto ended"
        with socket.socket() as one:
            return one.connect_ex(("127.0.0.1", self.port)) == 0


class Node:
    """The sample's sensor node, in a process of its own."""

    def __init__(self, broker: Broker, *facts: str, name: str = "bench", run: str = "main") -> None:
        command = [sys.executable, str(NODE), "--broker", broker.address, "--site", "lab"]
        command += ["--run", run, "--node", name, "--rate", "20"]
        for fact in facts:
            command += ["--fact", fact]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, text=True)

    def say(self, line: str) -> None:
        """Type a line: ``camera 0``."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{line}\n")
        self._process.stdin.flush()

    def freeze(self) -> None:
        self._process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self._process.send_signal(signal.SIGCONT)

    def end(self) -> None:
        """In order: it says that it goes."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait(PATIENCE)

    def kill(self) -> None:
        """kill -9; twice is harmless."""
        self._process.kill()
        self._process.wait()
        if self._process.stdin is not None and not self._process.stdin.closed:
            self._process.stdin.close()


class Speaker:
    """Anybody who sends anything to a broker."""

    def __init__(self, broker: Broker) -> None:
        self._client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
        self._client.connect("127.0.0.1", broker.port)
        self._client.loop_start()

    def send(self, topic: str, payload: bytes | Mapping[str, Any], *, retain: bool = False) -> None:
        """Send, and come back when the broker has it."""
        raw = payload if isinstance(payload, bytes) else json.dumps(payload).encode()
        self._client.publish(topic, raw, qos=1, retain=retain).wait_for_publish(PATIENCE)

    def flood(self, topic: str, messages: Sequence[Mapping[str, Any]]) -> None:
        """Send all of them as quickly as it goes."""
        for message in messages:
            sent = self._client.publish(topic, json.dumps(message).encode())
        sent.wait_for_publish(PATIENCE)

    def close(self) -> None:
        self._client.disconnect()
        self._client.loop_stop()


def free_port() -> int:
    """A port of this machine that nobody listens to."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
        return port
