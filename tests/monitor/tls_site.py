"""A site with TLS, a broker that obeys its rights, and programs that log in there."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from paho.mqtt.client import Client, MQTTv5
from paho.mqtt.enums import CallbackAPIVersion

from smsl_studio import front
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.front.sites.login_file import read_login
from smsl_studio.front.sites.new_site import make_site
from smsl_studio.monitor.facts import SourceState
from smsl_studio.monitor.login import Login
from smsl_studio.monitor.reception import RemoteView
from smsl_studio.monitor.topics import FactTopic, StatusTopic
from smsl_studio.runlog.events import Event, FactChanged
from smsl_studio.seal.certificates import Certified, new_certificate
from tests.monitor.broker import PATIENCE, Broker, free_port, until

MAX_AGE = 0.4
EYE = FactTopic("ward", "main", "SB", 0, "eye")
FORCE = FactTopic("ward", "main", "SB", 1, "force")
SITE = """
site = "ward"
[node.eye]
title = "Eye"
kind = "device"
facts = {"SB/0" = "eye"}
[node.clamp]
title = "Clamp"
kind = "device"
facts = {"SB/1" = "force"}
"""
BLUEPRINT = {
    "SB": {
        "HEADER": {"INITIAL": "State_a1", "ACTIVATING": "State_b1", "NUM_FACTS": 2},
        "_facts": {
            "0": {"max_age": MAX_AGE},
            "1": {
                "max_age": MAX_AGE,
                "sources": {"force": "N"},
                "range": {"force": [0, 100]},
                "predicate": {"0": "force < 5 N", "1": "force > 10 N"},
            },
        },
        "State_a1": {"Op_go": "State_b1", "Op_loosen": "State_a0"},
        "State_a0": {"Op_fix": "State_a1"},
        "State_b1": {"Op_back": "State_a1"},
    }
}


class TlsSite:
    """The folder of a site, and the broker that runs with its configuration."""

    def __init__(self, folder: Path, login: str = "certificate") -> None:
        folder.mkdir(exist_ok=True)
        (folder / "site.toml").write_text(SITE, "utf-8")
        self.port = free_port()
        self.made = make_site(folder, port=self.port, login=login)
        self.folder, self.keys = folder, folder / "keys"
        (folder / "sb.json").write_text(json.dumps(BLUEPRINT), "utf-8")
        self.bind(self.port)
        self.broker = Broker(folder, self.port, self.made.configuration)

    def bind(self, port: int, name: str = "localhost") -> None:
        """Let the next run look for its broker there."""
        text = f'[mqtt]\nbroker = "{name}:{port}"\nsite = "ward"\nlogin = "keys/studio.toml"\n'
        text += 'room = "site.toml"\n[mqtt.facts]\n"SB/0" = "eye"\n"SB/1" = "force"\n'
        (self.folder / "sb.toml").write_text(text, "utf-8")

    def login(self, name: str) -> Login:
        return read_login(self.keys / f"{name}.toml")

    def issue(self, name: str, days: int = 1, ago: int = 0, hosts: tuple[str, ...] = ()) -> Login:
        """Another certificate of this authority, made some days ago."""
        authority = Certified(
            (self.keys / "authority.pem").read_bytes(), (self.keys / "authority.key").read_bytes()
        )
        now = datetime.now(UTC) - timedelta(days=ago)
        made = new_certificate(authority, name, now, days, hosts)
        stem = f"{name}-{days}-{ago}-{len(hosts)}"
        certificate, key = self.keys / f"{stem}.pem", self.keys / f"{stem}.key"
        certificate.write_bytes(made.certificate)
        key.write_bytes(made.private)
        return Login(certificate, self.keys / "authority.pem", certificate, key)


class Voice:
    """A program that logs in and says what it likes."""

    def __init__(self, site: TlsSite, login: Login | None, name: str = "") -> None:
        self.name, self.boot, self.sequence, self.newest = name, 100, 0, 0.0
        self._codes: dict[int, str] = {}
        self._sent = 0
        self.refused = ""
        self.connected = threading.Event()
        self._steady = threading.Event()
        self._thread: threading.Thread | None = None
        self._client = client = Client(CallbackAPIVersion.VERSION2, protocol=MQTTv5)
        client.reconnect_delay_set(0.2, 0.2)  # type: ignore[arg-type]
        client.on_connect = self._answered
        client.on_publish = lambda c, d, m, code, p: self._codes.update({m: str(code)})
        client.on_disconnect = self._lost
        if login is not None:
            client.tls_set_context(login.context())
            if login.user:
                client.username_pw_set(login.user, login.password)
        try:
            client.connect("localhost", site.port, keepalive=5)
        except OSError as error:
            self.refused = str(error)
            return
        client.loop_start()

    def answer(self) -> str:
        """What came of the connection: the empty text, or why there is none."""
        until(lambda: self.connected.is_set() or bool(self.refused), "an answer")
        return self.refused

    def say(self, topic: FactTopic, value: Any, retain: bool = False, **changed: Any) -> None:
        """Send one sample; the next sequence and the present time if nothing else is said."""
        self.sequence += 1
        self.newest = time.monotonic()
        message = {
            "version": 1, "node": self.name, "boot": self.boot, "sequence": self.sequence,
            "time": self.newest, "value": value, **changed,
        }  # fmt: skip
        self.send(str(topic), json.dumps(message).encode(), retain)

    def send(self, topic: str, raw: bytes, retain: bool = False) -> None:
        self._sent = self._client.publish(topic, raw, qos=1, retain=retain).mid

    def acknowledged(self) -> str:
        """What the broker said about the newest message."""
        until(lambda: self._sent in self._codes, "the broker answers")
        return self._codes[self._sent]

    def steady(self, topic: FactTopic, value: Any) -> Voice:
        """Go on sending this value until ``hush``. What it said until now ends first."""
        self.hush()
        self._steady.clear()

        def speak() -> None:
            while not self._steady.wait(0.02):
                if self._client.is_connected():
                    self.say(topic, value)

        self._thread = threading.Thread(target=speak, daemon=True)
        self._thread.start()
        return self

    def hush(self) -> None:
        """Stay connected and say nothing."""
        self._steady.set()
        if self._thread is not None:
            self._thread.join()

    def close(self) -> None:
        self.hush()
        self._client.disconnect()
        self._client.loop_stop()

    def _answered(self, client: Any, data: Any, flags: Any, code: Any, more: Any) -> None:
        if code.is_failure:
            self.refused = str(code)
        else:
            self.connected.set()

    def _lost(self, client: Any, data: Any, flags: Any, code: Any, more: Any) -> None:
        if not self.connected.is_set():
            self.refused = self.refused or str(code) or "the connection was ended"


class AtSite:
    """A run at the site, and everything that it told about its facts."""

    def __init__(self, site: TlsSite, automatic: bool = False) -> None:
        self.dispatcher: Dispatcher = front.open_run(
            read(site.folder / "sb.json"), "table", host="local", automatic=automatic,
            attended=True,
        )  # fmt: skip
        self.events: list[Event] = list(self.dispatcher.open())
        self._counted: dict[str, int] = {}

    def begin(self) -> None:
        """Count events and refusals from here on."""
        self.events.clear()
        self._counted = {one.kind: one.count for one in self.view.received.refusals}

    def tick(self) -> None:
        self.events += self.dispatcher.tick()

    def until(self, condition: Callable[[], bool], what: str) -> None:
        def there() -> bool:
            self.tick()
            return condition()

        until(there, what)

    def until_fact(self, digit: int, value: str | None) -> None:
        self.until(lambda: self.value(digit) == value, f"fact {digit} reads {value}")

    def until_refused(self, kind: str) -> str:
        """Wait until such a message was refused, and return the example."""
        self.until(lambda: kind in self.refusals(), kind)
        return self.refusals()[kind]

    def refusals(self) -> dict[str, str]:
        """The newest example of each kind of message that was refused since ``begin``."""
        refused = self.view.received.refusals
        return {one.kind: one.example for one in refused
                if one.count > self._counted.get(one.kind, 0)}  # fmt: skip

    def wait(self, condition: Callable[[], bool], what: str) -> None:
        """Wait without a tick, so that nothing is fetched."""
        until(condition, what)

    def value(self, digit: int) -> str | None:
        return self.dispatcher.status.scene.readings["SB", digit].value

    def why(self, digit: int) -> str:
        return self.dispatcher.status.scene.readings["SB", digit].reason

    def source(self, name: str) -> SourceState:
        (found,) = (one for one in self.dispatcher.status.sources if one.said.source == name)
        return found

    def newest(self, name: str) -> int:
        """The sequence of the newest sample of a source that was read."""
        sample = self.source(name).sample
        return -1 if sample is None else sample.sequence

    @property
    def view(self) -> RemoteView:
        opened = self.dispatcher.opened
        assert opened is not None
        assert opened.remote is not None
        found = opened.remote.view()
        assert isinstance(found, RemoteView)
        return found

    def values(self, digit: int) -> set[str | None]:
        """All values that a fact had in this run."""
        told = (event for event in self.events if isinstance(event, FactChanged))
        return {event.value for event in told if (event.branch, event.digit) == ("SB", digit)}


def half_open(site: TlsSite) -> socket.socket:
    """A connection that says nothing: no TLS, no message, no end."""
    return socket.create_connection(("127.0.0.1", site.port), PATIENCE)


def status(node: str) -> str:
    return str(StatusTopic("ward", node))
