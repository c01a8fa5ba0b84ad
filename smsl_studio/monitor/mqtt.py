"""MQTT 5, by paho: the one file that knows it, loaded where a broker is named.

There is one connection for the nodes, one for each declared source, so that none is held up by what
another floods, and one for whatever else is said of the run, so that a source nobody declared is
seen and counted. paho reads each in a thread of its own. Each message gets the monotonic time at
which it was read, and goes to the ``Reception``. Sessions begin clean at every connection, so that
a broker hands out nothing that it kept while we were away; they are connected again by themselves.
"""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import RunRefused, UsageError
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.topics import START, written

if TYPE_CHECKING:
    from paho.mqtt.client import Client, MQTTMessage

PORT = 1883
KEEPALIVE = 2
"""Seconds of silence after which both sides ask whether the other is there."""
ANSWER = 3.0
"""Seconds that a broker may take to answer the connection."""
WAITS = 1, 4
"""The shortest and longest wait (s) before it is connected again."""
LARGEST_PACKET = 65536
"""Bytes: a broker keeps larger ones for itself."""
IN_FLIGHT = 20
"""Messages of a source under way at once; further ones wait at the broker, and are dropped
there."""
BUFFER = 16384
"""Bytes that may wait in this system: a hundred messages."""


def host_and_port(text: str) -> tuple[str, int]:
    """``HOST``, ``HOST:PORT`` or ``[V6]:PORT``; UsageError where it is neither."""
    host, port = text.strip(), str(PORT)
    if host.startswith("["):
        host, _, rest = host[1:].partition("]")
        port = rest.removeprefix(":") or port
    elif host.count(":") == 1:
        host, _, port = host.partition(":")
    plain = port.isascii() and port.isdecimal() and len(port) < 6
    if not host or any(c.isspace() for c in host) or not plain or not 0 < int(port) < 65536:
        raise UsageError(f"the broker is {text!r}", advice="Write HOST or HOST:PORT.")
    return host, int(port)


class BrokerLink:
    """The connections to one broker, for one reception."""

    def __init__(self, broker: str, reception: Reception) -> None:
        self.broker = broker
        self._where = host_and_port(broker)
        self._reception = reception
        self._ears: list[_Ear] = []
        self._nodes: _Ear | None = None
        self._left = False
        self._since = monotonic()

    def open(self) -> None:
        """Connect and subscribe; RunRefused where there is no broker, or it does not answer."""
        reception = self._reception
        site, run = written(reception.site), written(reception.run)
        nodes = _Ear(f"{START}{site}/node/+/status", self._hear)
        sources = [_Ear(topic, self._hear) for topic in reception.topics]
        others = _Ear(f"{START}{site}/run/{run}/fact/#", self._overhear, quality=0)
        self._nodes = nodes
        try:
            words = nodes.connect(*self._where)
        except OSError as error:
            words = error.strerror or str(error)
        except ValueError as error:
            words = str(error)
        if self._left:
            words = "it was left"
        if words:
            nodes.close()
            raise RunRefused(
                f"there is no broker at {self._where[0]}:{self._where[1]}: {words}",
                advice="Start one, such as mosquitto, or name another: --broker HOST:PORT.",
            )
        for ear in (*sources, others):
            ear.connect_later(*self._where)
        self._ears = [nodes, *sources, others]
        if self._left:
            self.close()

    @property
    def connected(self) -> bool:
        """Whether the broker is there, as far as is known."""
        return self.lost is None

    @property
    def lost(self) -> float | None:
        """For how long (s) the broker has been gone; None while it is there."""
        if not self._ears:
            return monotonic() - self._since
        since = self._ears[0].lost
        return None if since is None else monotonic() - since

    @property
    def connections(self) -> int:
        """How often it was connected."""
        return self._ears[0].connections if self._ears else 0

    def close(self) -> None:
        """Close all connections; calling it twice is harmless."""
        self._left = True
        ears, self._ears, self._since = self._ears, [], monotonic()
        nodes, self._nodes = self._nodes, None
        if not ears and nodes is not None:
            nodes.leave()
        for ear in ears:
            ear.leave()
        for ear in ears:
            ear.close()

    def _hear(self, topic: str, payload: bytes, retained: bool) -> None:
        self._reception.receive(topic, payload, retained, monotonic())

    def _overhear(self, topic: str, payload: bytes, retained: bool) -> None:
        if topic not in self._reception.topics:
            self._hear(topic, payload, retained)


class _Ear:
    """One connection that subscribes to one topic, or to one pattern of topics."""

    def __init__(
        self, topic: str, hear: Callable[[str, bytes, bool], None], quality: int = 1
    ) -> None:
        from paho.mqtt import client as paho
        from paho.mqtt.enums import CallbackAPIVersion

        self.lost: float | None = monotonic()
        self.connections = 0
        self._topic, self._quality, self._hear = topic, quality, hear
        self._changed = threading.Condition()
        self._refused = ""
        self._client = client = paho.Client(CallbackAPIVersion.VERSION2, protocol=paho.MQTTv5)
        client.connect_timeout = ANSWER
        client.reconnect_delay_set(*WAITS)
        client.on_socket_open = _keep_little
        client.on_connect = self._on_connect
        client.on_disconnect = self._on_disconnect
        client.on_message = self._on_message

    def connect(self, host: str, port: int) -> str:
        """Connect now; the empty text, or why the broker is none. OSError: nobody is there."""
        self._client.connect(host, port, KEEPALIVE, clean_start=True, properties=_asking())
        self._client.loop_start()
        with self._changed:
            self._changed.wait_for(lambda: self.lost is None or bool(self._refused), ANSWER)
        if self.lost is None:
            return ""
        return self._refused or "it accepts the connection and says nothing"

    def connect_later(self, host: str, port: int) -> None:
        """Connect as soon as the broker can be reached."""
        self._client.connect_async(host, port, KEEPALIVE, clean_start=True, properties=_asking())
        self._client.loop_start()

    def leave(self) -> None:
        """Disconnect; a thread that waits for the broker's answer stops waiting."""
        self._client.disconnect()
        with self._changed:
            self._refused = "it was left"
            self._changed.notify_all()

    def close(self) -> None:
        """End the thread, also one that is just being connected."""
        self._client.disconnect()
        self._client.loop_stop()
        left = self._client.socket()
        if left is not None:
            left.close()
        # paho frees what it holds besides when nothing points at it any more.
        self._client.on_connect = self._client.on_disconnect = None
        self._client.on_message = self._client.on_socket_open = None

    def _on_connect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        from paho.mqtt.subscribeoptions import SubscribeOptions

        with self._changed:
            if code.is_failure:
                self._refused = str(code)
            else:
                # A fact that was kept shall be seen as one, so that it is refused and counted.
                options = SubscribeOptions(qos=self._quality, retainAsPublished=True)
                client.subscribe(self._topic, options=options)
                self.lost = None
                self.connections += 1
            self._changed.notify_all()

    def _on_disconnect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        self.lost = monotonic() if self.lost is None else self.lost

    def _on_message(self, client: Client, data: Any, message: MQTTMessage) -> None:
        try:
            topic = message.topic
        except UnicodeDecodeError:
            topic = "(no UTF-8)"
        self._hear(topic, bytes(message.payload), bool(message.retain))


def _keep_little(client: Client, data: Any, opened: Any) -> None:
    """What waits in the system's buffers is old when it is read."""
    opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)


def _asking() -> Any:
    from paho.mqtt.packettypes import PacketTypes
    from paho.mqtt.properties import Properties

    properties = Properties(PacketTypes.CONNECT)  # type: ignore[no-untyped-call]
    properties.MaximumPacketSize = LARGEST_PACKET
    properties.ReceiveMaximum = IN_FLIGHT
    return properties
