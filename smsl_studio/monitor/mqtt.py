"""The MQTT 5 connections of a run. Only this file uses paho; it is loaded if a broker is named.

There is one connection for the nodes and one for each declared source, so that a flood from one
source delays no other. One more connection reads all other messages of the run, so that undeclared
sources are counted. paho reads each connection in a thread of its own. Each message goes to the
``Reception`` with the monotonic time at which it was read. Every connection begins a clean session,
so the broker sends no messages that it kept during an interruption. A lost connection is made again
without a call. With a login every connection is made with TLS (see ``login``).
"""

from __future__ import annotations

import socket
import ssl
import threading
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import RunRefused, UsageError
from smsl_studio.monitor.login import Login, tls_words
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.topics import START, written

if TYPE_CHECKING:
    from paho.mqtt.client import Client, MQTTMessage

PORT, TLS_PORT = 1883, 8883
KEEPALIVE = 2
"""The time (s) of silence after which each side checks the connection."""
ANSWER = 3.0
"""The time (s) that a broker may take to accept a connection."""
WAITS = 1, 4
"""The shortest and the longest wait (s) before a new attempt to connect."""
LARGEST_PACKET = 65536
"""The largest packet in bytes. A broker does not send larger packets."""
IN_FLIGHT = 20
"""The largest number of unconfirmed messages of one connection. The broker drops further ones."""
BUFFER = 16384
"""The size of the system's receive buffer in bytes: about a hundred messages."""


def host_and_port(text: str, usual: int = PORT) -> tuple[str, int]:
    """Read the address of a broker: ``HOST``, ``HOST:PORT`` or ``[V6]:PORT``. ``usual`` is the port
    if none is named. UsageError for any other text."""
    host, port = text.strip(), str(usual)
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
    """The connections to one broker. Their messages go to one reception."""

    def __init__(self, broker: str, reception: Reception, login: Login | None = None) -> None:
        self.broker = broker
        self.secure = login is not None
        """Whether the connections are encrypted."""
        self._where = host_and_port(broker, TLS_PORT if login is not None else PORT)
        self._login = _Shown(login) if login is not None else None
        self._reception = reception
        self._subscriptions: list[_Subscription] = []
        self._nodes: _Subscription | None = None
        self._left = False
        self._since = monotonic()

    def open(self) -> None:
        """Connect and subscribe. RunRefused if there is no broker, or if it does not answer."""
        reception = self._reception
        site, run = written(reception.site), written(reception.run)
        shows = self._login
        nodes = _Subscription(f"{START}{site}/node/+/status", self._hear, shows)
        sources = [_Subscription(topic, self._hear, shows) for topic in reception.topics]
        others = _Subscription(
            f"{START}{site}/run/{run}/fact/#", self._hear_undeclared, shows, quality=0
        )
        self._nodes = nodes
        try:
            words = nodes.connect(*self._where)
        except ssl.SSLError as error:
            words = tls_words(error)
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
                advice=_SECURE_ADVICE
                if self.secure
                else "Start one, such as mosquitto, or name another: --broker HOST:PORT.",
            )
        for one in (*sources, others):
            one.connect_later(*self._where)
        self._subscriptions = [nodes, *sources, others]
        if self._left:
            self.close()

    @property
    def connected(self) -> bool:
        """Whether the broker is connected, as far as is known."""
        return self.lost is None

    @property
    def lost(self) -> float | None:
        """The time (s) since the connection was lost. None while there is a connection."""
        if not self._subscriptions:
            return monotonic() - self._since
        since = self._subscriptions[0].lost
        return None if since is None else monotonic() - since

    @property
    def connections(self) -> int:
        """The number of connections made so far."""
        return self._subscriptions[0].connections if self._subscriptions else 0

    def close(self) -> None:
        """Close all connections. A second call does nothing."""
        self._left = True
        subscriptions, self._subscriptions, self._since = self._subscriptions, [], monotonic()
        nodes, self._nodes = self._nodes, None
        if not subscriptions and nodes is not None:
            nodes.leave()
        for one in subscriptions:
            one.leave()
        for one in subscriptions:
            one.close()

    def _hear(self, topic: str, payload: bytes, retained: bool) -> None:
        self._reception.receive(topic, payload, retained, monotonic())

    def _hear_undeclared(self, topic: str, payload: bytes, retained: bool) -> None:
        if topic not in self._reception.topics:
            self._hear(topic, payload, retained)


_SECURE_ADVICE = (
    "See that it runs with the mosquitto.conf of this site, and that this login is of it, too."
)


class _Shown:
    """A login, and the settings of TLS that all its connections share."""

    def __init__(self, login: Login) -> None:
        self.context = login.context()
        self.user, self.password = login.user, login.password


class _Subscription:
    """One connection that subscribes to one topic, or to one pattern of topics."""

    def __init__(
        self,
        topic: str,
        hear: Callable[[str, bytes, bool], None],
        shows: _Shown | None = None,
        quality: int = 1,
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
        self._secure = shows is not None
        if shows is not None:
            client.tls_set_context(shows.context)
            if shows.user:
                client.username_pw_set(shows.user, shows.password)
        client.reconnect_delay_set(*WAITS)
        client.on_socket_open = _keep_little
        client.on_connect = self._on_connect
        client.on_disconnect = self._on_disconnect
        client.on_message = self._on_message

    def connect(self, host: str, port: int) -> str:
        """Connect now. Return the empty text, or the reason why the broker refused. OSError if no
        server answers."""
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
        """Disconnect, and end the wait of a thread for the broker's answer."""
        self._client.disconnect()
        with self._changed:
            self._refused = "it was left"
            self._changed.notify_all()

    def close(self) -> None:
        """End the thread, even during an attempt to connect."""
        self._client.disconnect()
        self._client.loop_stop()
        left = self._client.socket()
        if left is not None:
            left.close()
        # paho frees its other resources when no reference to them is left.
        self._client.on_connect = self._client.on_disconnect = None
        self._client.on_message = self._client.on_socket_open = None

    def _on_connect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        from paho.mqtt.subscribeoptions import SubscribeOptions

        with self._changed:
            if code.is_failure:
                self._refused = str(code)
            else:
                # With the retained flag a retained fact can be recognised, refused and counted.
                options = SubscribeOptions(qos=self._quality, retainAsPublished=True)
                client.subscribe(self._topic, options=options)
                self.lost = None
                self.connections += 1
            self._changed.notify_all()

    def _on_disconnect(self, client: Client, data: Any, flags: Any, code: Any, more: Any) -> None:
        with self._changed:
            if not self.connections and self._secure and not self._refused:
                # A broker that does not accept a certificate ends the connection without an answer.
                self._refused = "it ended the connection: it does not accept this login"
            self.lost = monotonic() if self.lost is None else self.lost
            self._changed.notify_all()

    def _on_message(self, client: Client, data: Any, message: MQTTMessage) -> None:
        try:
            topic = message.topic
        except UnicodeDecodeError:
            topic = "(no UTF-8)"
        self._hear(topic, bytes(message.payload), bool(message.retain))


def _keep_little(client: Client, data: Any, opened: Any) -> None:
    """Make the receive buffer small, because a message that waits in it is old when it is read."""
    opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)


def _asking() -> Any:
    from paho.mqtt.packettypes import PacketTypes
    from paho.mqtt.properties import Properties

    properties = Properties(PacketTypes.CONNECT)  # type: ignore[no-untyped-call]
    properties.MaximumPacketSize = LARGEST_PACKET
    properties.ReceiveMaximum = IN_FLIGHT
    return properties
