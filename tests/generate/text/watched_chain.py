"""A process that runs the chain against a server, and tells what it asks of the system meanwhile.

``python -m tests.generate.text.watched_chain URL CASES``: one line of JSON for each case. ``CASES``
is JSON: the seed of each, and the stage from which on its server answers slowly, or null.
"""

from __future__ import annotations

import json
import sys
import time
from urllib.parse import urlsplit

from smsl_studio.generate.text.prompts import STAGES
from smsl_studio.generate.text.provider import StageAnswer, StageQuestion
from smsl_studio.generate.text.reader_provider import TextReader
from smsl_studio.generate.text.server_provider import AnswerServer
from tests.generate.text.answering import chain

USUAL, SHORT = 60.0, 0.3
"""The limits (s) of one answer: of any, and of one of a server that is known to hang."""


class _Server:
    """Asks the server of a case. What is known to hang gets little time, and all else gets much, so
    that a machine with much to do changes nothing."""

    by_file = False
    attempts = AnswerServer.attempts

    def __init__(self, url: str, slow: int | None) -> None:
        self._patient, self._brief = AnswerServer(url, USUAL), AnswerServer(url, SHORT)
        self._slow = len(STAGES) if slow is None else slow

    def answer(self, question: StageQuestion) -> StageAnswer:
        late = STAGES.index(question.stage) >= self._slow
        return (self._brief if late else self._patient).answer(question)


HARMLESS = ("object.", "sys._", "builtins.id", "array.", "gc.", "code.", "_thread.", "time.")


def main() -> None:
    """Run the cases, and print what each did."""
    url, cases = sys.argv[1], json.loads(sys.argv[2])
    where = urlsplit(url)
    own = (where.hostname, where.port)
    heard: list[str] = []
    watching = False

    def hear(event: str, arguments: tuple[object, ...]) -> None:
        if not watching or event.startswith(HARMLESS):
            return
        if event == "socket.connect" and arguments[1] == own:
            return
        if event == "socket.getaddrinfo" and tuple(arguments[:2]) == own:
            return
        if event == "compile" and arguments[1] == "<unknown>":
            return  # the code of an answer is parsed, and nothing is made of it
        if event in ("socket.__new__", "http.client.connect", "http.client.send"):
            return  # a connection is told by ``socket.connect``
        heard.append(f"{event} {arguments!r}"[:300])

    # What is loaded late is loaded now: the watch shall hear answers alone.
    chain(TextReader())
    chain(_Server(f"{url}/{cases[0][0]}/warm", None))
    sys.addaudithook(hear)
    for seed, slow in cases:
        heard.clear()
        begun = time.monotonic()
        watching = True
        made = chain(_Server(f"{url}/{seed}/v1", slow))
        watching = False
        told = {
            "seed": seed,
            "sentence": made.lacking[0][0] if made.lacking else "",
            "files": sorted(made.files),
            "events": heard,
            "seconds": time.monotonic() - begun,
        }
        print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main()
