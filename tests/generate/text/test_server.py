"""A server on this machine that answers well, wrongly and with malice; and no server at all."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler
from pathlib import Path

import pytest

from smsl_studio.errors import UsageError
from smsl_studio.generate.text.reader_provider import TextReader
from smsl_studio.generate.text.server_provider import AnswerServer
from smsl_studio.shipped import samples_dir
from tests.cases import case
from tests.counts import share_of
from tests.generate.text.answering import (
    CARRIERS,
    SLOW,
    STAGES,
    chain,
    completion,
    good_answers,
    sent,
    server,
)
from tests.generate.text.hostile_cases import WHOLE, hostile_cases


def test_recorded_answers_make_the_blueprint_that_the_reader_makes() -> None:
    answers = iter(good_answers())
    with server(lambda handler, _: sent(handler, completion(next(answers)))) as (url, _prompts):
        made = chain(AnswerServer(url))
    assert made.lacking == []
    assert made.blueprint is not None
    reference = chain(TextReader()).blueprint
    assert reference is not None
    assert made.blueprint.behaviour == reference.behaviour
    assert '"model": "m"' in made.files["psm.json"]


def test_a_wrong_answer_is_asked_again_with_what_is_wrong() -> None:
    good = good_answers()
    wrong = json.dumps({"LAMP": {"State_0": {"a": "State_9"}, "State_1": {"b": "State_0"}}})
    answers = iter([*good[:2], wrong, f"Here it is:\n```json\n{good[2]}\n```", *good[3:]])
    with server(lambda handler, _: sent(handler, completion(next(answers)))) as (url, prompts):
        made = chain(AnswerServer(url))
    assert made.lacking == []
    assert "R02 LAMP/State_0/a" in prompts[3]
    kept = json.loads(made.files["answers.json"])["answers"]
    assert [one["stage"] for one in kept] == ["pm", "him", "psm", "psm", "rmm"]
    assert any(fault.startswith("R02") for fault in kept[2]["faults"])


def test_a_server_writes_functions_and_code_that_reaches_out_is_asked_again() -> None:
    def motion(line: str) -> str:
        code = f"def op_plug(world):\n    yield\n    {line}\n"
        return json.dumps({"functions": [{"operation": "LAMP/Op_Plug", "code": code}]})

    answers = iter([*good_answers()[:3], motion("import os"), motion("yield from do(world, 'x')")])
    with server(lambda handler, _: sent(handler, completion(next(answers)))) as (url, prompts):
        made = chain(AnswerServer(url))
    assert made.lacking == []
    assert "LAMP/Op_Plug: line 3: it imports os" in prompts[4]
    assert "    yield from do(world, 'x')\n" in made.files["rmm/LAMP.Op_Plug.py"]
    assert "NotImplementedError" in made.files["rmm/LAMP.Op_Switch.py"]


def test_after_three_repairs_a_stage_is_given_up() -> None:
    with server(lambda handler, _: sent(handler, completion("no"))) as (url, prompts):
        made = chain(AnswerServer(url))
    assert len(prompts) == 4
    assert made.lacking[0][0].startswith("stage pm was given up after 4 answers")
    assert len(json.loads(made.files["answers.json"])["answers"]) == 4


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("hang", "takes longer than"),
        ("drip", "takes longer than"),
        ("head", "takes longer than"),
        ("large", "larger than 4 MB"),
        ("redirect", "it leads elsewhere"),
        ("page", "a page and no data"),
        ("fault", "status 500"),
        ("other", "something else than a completion"),
        ("short", "gives no answer"),
    ],
)
def test_a_hostile_server_is_one_sentence(kind: str, words: str) -> None:
    gone = threading.Event()
    slow = kind in SLOW
    with server(lambda handler, _: CARRIERS[kind](handler, gone)) as (url, _prompts):
        made = chain(AnswerServer(url, seconds=0.3 if slow else 20))
        gone.set()
    ((sentence, _advice),) = made.lacking
    assert words in sentence


def test_nobody_listens_is_one_sentence() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        made = chain(AnswerServer(f"http://127.0.0.1:{taken.getsockname()[1]}"))
    assert "gives no answer" in made.lacking[0][0]


@pytest.mark.parametrize(
    "url", ["http://", "http://a b", "https://me:word@host/v1", "http://h/?key=1", "http://h:99999"]
)
def test_a_url_that_is_none_is_refused(url: str) -> None:
    with pytest.raises(UsageError):
        AnswerServer(url)


def test_a_key_is_sent_to_the_url_alone_and_written_nowhere(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("SMSL_TEXT_KEY", "secret-of-mine")
    seen: list[str | None] = []
    answers = iter(good_answers())

    def reply(handler: BaseHTTPRequestHandler, _: str) -> None:
        seen.append(handler.headers["Authorization"])
        sent(handler, completion(next(answers)))

    with server(reply) as (url, _prompts):
        made = chain(AnswerServer(url))
    assert set(seen) == {"Bearer secret-of-mine"}
    assert not any("secret-of-mine" in text for text in made.files.values())
    with pytest.raises(UsageError, match="without encryption"):
        AnswerServer("http://example.org/v1")


def test_nothing_of_a_hostile_answer_is_run_opened_or_fetched(tmp_path: Path) -> None:
    """A share of the 200 of the bench ``hostile``."""
    bait = tmp_path / "bait.json"
    bait.write_text('{"BAIT": {"State_0": {}}}')
    found = hostile_cases(range(share_of(WHOLE)), bait)
    assert len(found) == share_of(WHOLE)
    for one in found:
        with case("seed", one.seed, one.kind):
            assert one.events == ()
            assert one.sentence or one.stage == STAGES - 1  # no function at all fits, too
            assert "\n" not in one.sentence
            reached = ("answers.json", "pm.md", "him.toml", "psm.json")[: one.stage + 1]
            assert set(reached) <= set(one.files)
    assert [path.name for path in tmp_path.iterdir()] == ["bait.json"]
    assert len({one.stage for one in found}) == STAGES
    assert len({one.kind for one in found}) > 3


UNCONNECTED = """
import json, os, sys
from smsl_studio.front.generated_text import generate_text

heard = []
sys.addaudithook(lambda event, told: heard.append(f"{event} {told!r}"[:200])
                 if event.startswith("socket.") and event != "socket.__new__" else None)
texts, out = sys.argv[1], sys.argv[2]
files, hardware = [f"{texts}/first-aid.md"], f"{texts}/first-aid-hardware.md"
made = generate_text(files, f"{out}/made/a.json", hardware=hardware)
assert made.is_good, made
kept = f"replay:{out}/made/answers.json"
again = generate_text(files, f"{out}/again/a.json", hardware=hardware, provider=kept)
assert again.is_good, again
given = generate_text(files, f"{out}/hand/a.json", hardware=hardware, by_hand=f"{out}/made")
assert given.is_good, given
print(json.dumps(heard))
"""


def test_nothing_leaves_the_machine_without_a_base_url(tmp_path: Path) -> None:
    """The reader, kept answers and answers by hand ask for no connection and no name."""
    proxies = dict.fromkeys(("http_proxy", "https_proxy", "ALL_PROXY"), "http://127.0.0.1:9")
    words = [sys.executable, "-c", UNCONNECTED, str(samples_dir() / "texts"), str(tmp_path)]
    ran = subprocess.run(
        words, env={**os.environ, **proxies}, capture_output=True, timeout=120, check=False
    )
    assert ran.returncode == 0, ran.stderr.decode()
    assert json.loads(ran.stdout) == []
