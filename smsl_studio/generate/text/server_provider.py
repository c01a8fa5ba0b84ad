"""The provider of a base URL: any server that speaks the chat completions of OpenAI.

Nothing is sent but to the URL that the user gave. A redirect is not followed, no proxy of the
environment is asked, and time and size are bounded whatever the server does. The standard library
does this in one file, because a client library follows redirects, asks proxies and retries.
"""

from __future__ import annotations

import http.client
import ipaddress
import json
import os
import ssl
import threading
from typing import Any
from urllib.parse import SplitResult, urlsplit

from smsl_studio.errors import UsageError
from smsl_studio.generate.text.answers import LONGEST_ANSWER, AnswerFault, json_of
from smsl_studio.generate.text.provider import StageAnswer, StageQuestion, Unanswered

Json = Any
KEY, MODEL = "SMSL_TEXT_KEY", "SMSL_TEXT_MODEL"
"""The variables of the environment with the key and the name of the model. The key is sent to the
URL that the user gave, and written nowhere."""
LARGEST = 4 << 20
"""The largest size of a response (bytes)."""
SECONDS = 300.0
"""The wall time (s) for one answer, from the call to its last byte."""
_ADVICE = "What was reached is kept. Look at the server, or write this stage by hand."
_PARAMETERS: dict[str, Json] = {"temperature": 0, "seed": 0}


class AnswerServer:
    """Asks a server at a base URL, such as ``http://127.0.0.1:8080/v1``."""

    by_file = False
    attempts = 4

    def __init__(self, url: str, seconds: float = SECONDS) -> None:
        self._url = _checked(url)
        self._seconds = seconds
        self._key = os.environ.get(KEY, "")
        self._model = self._url.fragment or os.environ.get(MODEL, "") or "default"
        if self._key and self._url.scheme == "http" and not _is_loopback(self._url.hostname or ""):
            raise UsageError(
                "a key is not sent without encryption", advice=f"Use https, or unset {KEY}."
            )
        if not (self._key.isascii() and self._key.isprintable()):
            raise UsageError(f"{KEY} holds what no key holds", advice="Set it again.")

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return the answer of the server. Unanswered, with the reason, if there is none."""
        body = {
            "model": self._model,
            "messages": [{"role": "user", "content": question.prompt}],
            "stream": False,
            **_PARAMETERS,
        }
        told = self._asked(json.dumps(body).encode())
        try:
            found = json_of(told, LARGEST)
            text = found["choices"][0]["message"]["content"]
            model = found.get("model", self._model)
        except (AnswerFault, KeyError, IndexError, TypeError):
            raise self._refused("it answers something else than a completion") from None
        if not isinstance(text, str) or not isinstance(model, str):
            raise self._refused("it answers something else than a completion")
        return StageAnswer(text[: LONGEST_ANSWER + 1], model[:200], _PARAMETERS)

    def _refused(self, reason: str) -> Unanswered:
        where = self._url.netloc
        return Unanswered(f"the server at {where} gives no answer: {reason}", _ADVICE)

    def _asked(self, body: bytes) -> str:
        host, port = self._url.hostname or "", self._url.port
        line: http.client.HTTPConnection
        if self._url.scheme == "https":
            context = ssl.create_default_context()
            line = http.client.HTTPSConnection(host, port, timeout=self._seconds, context=context)
        else:
            line = http.client.HTTPConnection(host, port, timeout=self._seconds)
        late = threading.Event()
        # A socket's limit begins anew with each byte, so a clock of its own ends a server that
        # drips its head, and tells the loop below to end one that drips its body.
        clock = threading.Timer(self._seconds, _end, (line, late))
        clock.daemon = True
        clock.start()
        try:
            return self._exchange(line, body, late)
        except (OSError, http.client.HTTPException, ValueError) as error:
            if late.is_set() or isinstance(error, TimeoutError):
                raise self._refused(f"it takes longer than {self._seconds:g} s") from None
            reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
            raise self._refused(" ".join(reason.split())[:200]) from None
        finally:
            clock.cancel()
            line.close()

    def _exchange(
        self, line: http.client.HTTPConnection, body: bytes, late: threading.Event
    ) -> str:
        key = {"Authorization": f"Bearer {self._key}"} if self._key else {}
        path = f"{self._url.path.rstrip('/')}/chat/completions"
        headers = {"Content-Type": "application/json", "Accept-Encoding": "identity", **key}
        line.request("POST", path, body, headers)
        response = line.getresponse()
        if late.is_set():
            raise TimeoutError
        if 300 <= response.status < 400:
            raise self._refused(f"it leads elsewhere (status {response.status})")
        if response.status != 200:
            raise self._refused(f"status {response.status}")
        parts, size = [], 0
        while part := response.read1(1 << 16):
            parts.append(part)
            size += len(part)
            if late.is_set():
                raise TimeoutError
            if size > LARGEST:
                raise self._refused(f"the answer is larger than {LARGEST >> 20} MB")
        if response.length:
            raise self._refused("the answer was broken off")
        text = b"".join(parts).decode("utf-8")
        if text.lstrip()[:1] == "<":
            raise self._refused("it answers a page and no data")
        return text


def _end(line: http.client.HTTPConnection, late: threading.Event) -> None:
    late.set()
    sock = line.sock
    if sock is not None:
        try:
            sock.shutdown(2)
        except OSError:
            return  # it is closed already


def _checked(url: str) -> SplitResult:
    try:
        found = urlsplit(url)
        fits = found.scheme in ("http", "https") and bool(found.hostname) and found.port != 0
    except ValueError:
        fits = False
    if not fits or not url.isascii() or not url.isprintable() or " " in url:
        raise UsageError(f"{url!r} is no base URL", advice="Write http://127.0.0.1:8080/v1.")
    if found.username is not None or found.query:
        raise UsageError(
            "the base URL holds a name, a password or a query",
            advice=f"Put the key into {KEY}; it is written nowhere.",
        )
    return found


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
