"""MQTT 5, by paho: the one file that knows it, loaded where a broker is named.

paho reads in a thread of its own. Each message gets the monotonic time at which it was read, and
goes to the ``Reception``. The session begins clean at every connection, so that a broker hands out
nothing that it kept while we were away; it is connected again by itself.
"""

from __future__ import annotations

import contextlib
import threading
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
"""Seconds a broker may take to say hello."""
WAITS = 1, 4
"""The shortest and longest wait (s) before it is connected again."""
LARGEST_PACKET = 65536
"""Bytes: a broker keeps larger ones for itself."""
IN_FLIGHT = 100
"""Messages on their way to us at once; a flood waits at the broker, which drops it there."""


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


class Link:
    """The connection to one broker, for one reception."""

    def __init__(self, broker: str, reception: Reception) -> None:
        self.broker = broker
        self._host, self._port = host_and_port(broker)
        self._reception = reception
        self._client: Client | None = None
        self._changed = threading.Condition()
        self._refused = ""
        self._lost: float | None = monotonic()
        self._connections = 0

    def open(self) -> None:
        """Connect and subscribe; RunRefused where there is no broker, or it does not answer."""
        self._client = client = self._made()
        try:
            client.connect(
                self._host, self._port, KEEPALIVE, clean_start=True, properties=_asking()
            )
        except (OSError, ValueError) as error:
            raise self._none(str(error)) from None
        client.loop_start()
        with self._changed:
            self._changed.wait_for(lambda: self.connected or bool(self._refused), ANSWER)
        if not self.connected:
            words = self._refused or "it accepts the connection and says nothing"
            self.close()
            raise self._none(words)

    @property
    def connected(self) -> bool:
        """Whether the broker is there, as far as is known."""
        return self._lost is None

    @property
    def lost(self) -> float | None:
        """For how long (s) the broker has been gone; None while it is there."""
        since = self._lost
        return None if since is None else monotonic() - since

    @property
    def connections(self) -> int:
        """How often it was connected."""
        return self._connections

    def close(self) -> None:
        """Hear nothing more; twice is harmless."""
        client, self._client = self._client, None
        if client is not None:
            client.disconnect()
            client.loop_stop()

    def _none(self, words: str) -> RunRefused:
        return RunRefused(
            f"there is no broker at {self._host}:{self._port}: {words}",
            advice="Start one, such as mosquitto, or name another: --broker HOST:PORT.",
        )

    def _made(self) -> Client:
        from paho.mqtt import client as paho
        from paho.mqtt.enums import CallbackAPIVersion

        client = paho.Client(CallbackAPIVersion.VERSION2, protocol=paho.MQTTv5)
        client.connect_timeout = ANSWER
        client.reconnect_delay_set(*WAITS)
        client.on_connect = self._on_connect
        client.on_disconnect = self._on_disconnect
        client.on_message = self._on_message
        return client

    def _on_connect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        if code.is_failure:
            with self._changed:
                self._refused = str(code)
                self._changed.notify_all()
            return
        from paho.mqtt.subscribeoptions import SubscribeOptions

        site, run = written(self._reception.site), written(self._reception.run)
        # A fact that was kept shall be seen as one, so that it can be refused and counted.
        options = SubscribeOptions(qos=1, retainAsPublished=True)
        wanted = f"{START}{site}/node/+/status", f"{START}{site}/run/{run}/fact/#"
        client.subscribe([(topics, options) for topics in wanted])
        with self._changed:
            self._lost = None
            self._connections += 1
            self._changed.notify_all()

    def _on_disconnect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        with self._changed:
            self._lost = monotonic() if self._lost is None else self._lost

    def _on_message(self, client: Client, data: Any, message: MQTTMessage) -> None:
        topic = "(no UTF-8)"
        with contextlib.suppress(UnicodeDecodeError):
            topic = message.topic
        self._reception.receive(topic, bytes(message.payload), bool(message.retain), monotonic())


def _asking() -> Any:
    from paho.mqtt.packettypes import PacketTypes
    from paho.mqtt.properties import Properties

    properties = Properties(PacketTypes.CONNECT)  # type: ignore[no-untyped-call]
    properties.MaximumPacketSize = LARGEST_PACKET
    properties.ReceiveMaximum = IN_FLIGHT
    return properties
