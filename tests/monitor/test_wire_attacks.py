"""Attacks on the wire, on a real broker with TLS: each is refused or makes a fact unknown with a
reason, and none makes a wrong fact."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio.errors import RunRefused
from smsl_studio.front.sites.new_site import make_site
from smsl_studio.monitor.login import Login
from smsl_studio.runlog.events import Committed
from tests.monitor.broker import Broker, free_port
from tests.monitor.tls_site import EYE, FORCE, AtSite, TlsSite, Voice, half_open, status

START = {"a", None}
"""What the first fact may read in a run in which nobody moves anything."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TlsSite]:
    made = TlsSite(tmp_path_factory.mktemp("ward"))
    yield made
    made.broker.kill()


@pytest.fixture
def voices(site: TlsSite) -> Iterator[Callable[..., Voice]]:
    made: list[Voice] = []

    def voice(login: Login | None, name: str = "") -> Voice:
        made.append(Voice(site, login, name))
        return made[-1]

    yield voice
    for one in made:
        one.close()


class Standing:
    """A run with both of its nodes, shared by the tests. ``spoilt`` makes the next test begin
    another one."""

    def __init__(self, site: TlsSite) -> None:
        self.eye = Voice(site, site.login("eye"), "eye").steady(EYE, "a")
        self.clamp = Voice(site, site.login("clamp"), "clamp").steady(FORCE, 20.0)
        self.run = AtSite(site)
        self.spoilt = False

    def settle(self) -> None:
        """Let both nodes speak as they should, until both facts are known."""
        self.eye.steady(EYE, "a")
        self.clamp.steady(FORCE, 20.0)
        self.run.until_fact(0, "a")
        self.run.until_fact(1, "1")
        self.run.begin()

    def close(self) -> None:
        self.run.dispatcher.close()
        self.eye.close()
        self.clamp.close()


@pytest.fixture(scope="module")
def halls(site: TlsSite) -> Iterator[list[Standing]]:
    made: list[Standing] = []
    yield made
    for one in made:
        one.close()


@pytest.fixture
def standing(site: TlsSite, halls: list[Standing]) -> Standing:
    if halls and halls[0].spoilt:
        halls.pop().close()
    if not halls:
        site.bind(site.port)
        halls.append(Standing(site))
    halls[0].settle()
    return halls[0]


@pytest.fixture
def eye(standing: Standing) -> Voice:
    return standing.eye


@pytest.fixture
def clamp(standing: Standing) -> Voice:
    return standing.clamp


@pytest.fixture
def run(standing: Standing) -> Iterator[AtSite]:
    yield standing.run
    assert standing.run.values(0) <= START
    assert standing.run.values(1) <= {"1", None}
    assert not [event for event in standing.run.events if isinstance(event, Committed)]


def test_the_connection_is_encrypted_and_both_nodes_are_heard(run: AtSite) -> None:
    assert run.view.secure
    assert {node.name for node in run.view.nodes} == {"eye", "clamp"}


# Who may connect.


def test_a_certificate_of_another_authority(
    run: AtSite, tmp_path: Path, site: TlsSite, voices: Callable[..., Voice]
) -> None:
    other = make_site(tmp_path / "other", now=None)
    keys = other.site.folder / "keys"
    login = Login(keys, site.keys / "authority.pem", keys / "drill.pem", keys / "drill.key")
    assert voices(login, "eye").answer()


def test_an_expired_certificate(run: AtSite, site: TlsSite, voices: Callable[..., Voice]) -> None:
    assert voices(site.issue("eye", days=1, ago=9), "eye").answer()


def test_no_certificate(run: AtSite, site: TlsSite, voices: Callable[..., Voice]) -> None:
    bare = Login(site.keys, site.keys / "authority.pem")
    assert voices(bare, "eye").answer()


def test_no_tls(run: AtSite, voices: Callable[..., Voice]) -> None:
    assert voices(None, "eye").answer()


def test_a_certificate_of_a_stranger_has_no_rights(
    run: AtSite, site: TlsSite, voices: Callable[..., Voice]
) -> None:
    stranger = voices(site.issue("stranger"), "eye")
    assert stranger.answer() == ""
    stranger.say(EYE, "b")
    assert stranger.acknowledged() == "Not authorized"


# Who may speak for whom.


def test_the_topic_of_another_node(run: AtSite, clamp: Voice) -> None:
    clamp.hush()
    clamp.say(EYE, "b", boot=2**52)
    assert clamp.acknowledged() == "Not authorized"
    run.until_fact(0, "a")


def test_the_status_of_another_node(run: AtSite, clamp: Voice) -> None:
    clamp.hush()
    gone = b'{"version": 1, "boot": 9007199254740991, "state": "gone"}'
    clamp.send(status("eye"), gone, retain=True)
    assert clamp.acknowledged() == "Not authorized"
    states = {node.state for node in run.view.nodes if node.name == "eye"}
    assert states <= {"alive", "frozen"}, "a busy machine may be late; nobody is gone"


def test_the_name_of_another_node(run: AtSite, clamp: Voice) -> None:
    clamp.hush()
    clamp.say(FORCE, 1.0, node="eye")
    assert run.until_refused("under the name of another node") == "SB/1 force: eye, not clamp"
    run.until_fact(1, None)
    assert "no reading for" in run.why(1)


def test_a_stolen_key_is_a_second_speaker(
    run: AtSite, standing: Standing, site: TlsSite, voices: Callable[..., Voice]
) -> None:
    standing.spoilt = True
    thief = voices(site.login("eye"), "eye")
    thief.boot = 101
    thief.steady(EYE, "b")
    # A busy machine may leave the fact without any reading for a moment first.
    run.until(lambda: run.why(0).startswith("two speakers for eye"), "two speakers are seen")
    assert run.value(0) is None


def test_studio_itself_may_say_nothing(
    run: AtSite, site: TlsSite, voices: Callable[..., Voice]
) -> None:
    studio = voices(site.login("studio"), "eye")
    assert studio.answer() == ""
    studio.say(EYE, "b")
    assert studio.acknowledged() == "Not authorized"


# What is said.


def test_a_retained_old_sample(run: AtSite, eye: Voice) -> None:
    eye.hush()
    eye.say(EYE, "b", retain=True)
    assert run.until_refused("retained fact") == "SB/0 eye"
    run.until_fact(0, None)
    eye.send(str(EYE), b"", retain=True)


def test_a_flood_costs_its_own_source_and_no_other(run: AtSite, eye: Voice, clamp: Voice) -> None:
    eye.hush()
    before = run.view.received.samples
    for _ in range(1000):
        eye.say(EYE, "a")
    run.wait(lambda: run.view.received.samples > before + 1000, "all came")
    assert run.until_refused("overtaken before it was read") == "SB/0 eye"
    run.until_fact(1, "1")
    run.until_fact(0, None)


def test_samples_that_come_twice(run: AtSite, eye: Voice) -> None:
    eye.hush()
    run.until_fact(0, None)
    before = run.source("eye")
    eye.say(EYE, "b", sequence=eye.sequence, time=eye.newest)
    run.until(lambda: run.source("eye").repeated > before.repeated, "it is seen")
    assert run.source("eye").counted == before.counted


def test_disorder(run: AtSite, eye: Voice) -> None:
    eye.hush()
    eye.say(EYE, "a")
    run.until(lambda: run.newest("eye") == eye.sequence, "the newer one counts")
    repeated = run.source("eye").repeated
    eye.say(EYE, "b", sequence=eye.sequence - 1, time=eye.newest - 0.1)
    run.until(lambda: run.source("eye").repeated > repeated, "it is seen")


def test_a_sample_that_was_held_back(run: AtSite, eye: Voice) -> None:
    eye.hush()
    eye.say(EYE, "b", time=0.0)
    run.until_fact(0, None)


@pytest.mark.parametrize("jump", [-3600.0, 3600.0], ids=["back", "ahead"])
def test_a_clock_that_jumps(run: AtSite, standing: Standing, eye: Voice, jump: float) -> None:
    standing.spoilt = True
    eye.hush()
    eye.say(EYE, "b" if jump < 0 else "a", time=eye.newest + jump)
    run.until_fact(0, None)
    assert run.why(0)


def test_loss_of_every_second_sample(run: AtSite, clamp: Voice) -> None:
    clamp.hush()
    for _ in range(5):
        clamp.sequence += 1
        clamp.say(FORCE, 20.0)
        counted = run.source("force").counted
        run.until(lambda: run.source("force").counted > counted, "the next one counts")  # noqa: B023
    clamp.steady(FORCE, 20.0)
    run.until_fact(1, "1")


def test_a_node_that_starts_again(run: AtSite, standing: Standing, eye: Voice) -> None:
    standing.spoilt = True
    eye.hush()
    eye.boot, eye.sequence = 200, 0
    eye.say(EYE, "a")
    run.until(lambda: run.value(0) is None, "two boots are two speakers")
    eye.steady(EYE, "a")
    run.until_fact(0, "a")


def test_a_boot_that_is_over(run: AtSite, standing: Standing, eye: Voice) -> None:
    standing.spoilt = True
    eye.hush()
    eye.say(EYE, "b", boot=7)
    run.until_fact(0, None)
    assert run.why(0)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (b"NaN", "no JSON"),
        (b"Infinity", "no JSON"),
        (b'"plenty"', "not a number"),
        (b"true", "not a number"),
        (b"[1, 2]", "not a number"),
    ],
)
def test_what_is_no_number(run: AtSite, clamp: Voice, said: bytes, words: str) -> None:
    clamp.hush()
    raw = b'{"version": 1, "node": "clamp", "boot": 100, "sequence": 9999, "time": 1, "value": %s}'
    clamp.send(str(FORCE), raw % said)
    assert words in run.until_refused("unreadable fact")
    run.until_fact(1, None)


def test_a_number_out_of_range(run: AtSite, clamp: Voice) -> None:
    clamp.hush()
    clamp.say(FORCE, 1e9)
    run.until_fact(1, None)
    assert run.why(1) == "force: 1e+09 N is outside 0 to 100 N"


# The connection and the broker.


def test_half_open_sockets(run: AtSite, site: TlsSite) -> None:
    sockets = [half_open(site) for _ in range(30)]
    counted = run.source("eye").counted
    run.until(lambda: run.source("eye").counted > counted + 20, "the eye is heard as before")
    run.until_fact(0, "a")
    for one in sockets:
        one.close()


def test_a_node_that_is_silent(run: AtSite, eye: Voice) -> None:
    eye.hush()
    run.until_fact(0, None)
    assert run.why(0).startswith("no reading for")


def test_a_broker_that_is_frozen(run: AtSite, site: TlsSite) -> None:
    site.broker.freeze()
    run.until_fact(0, None)
    run.until_fact(1, None)
    site.broker.thaw()
    run.until_fact(0, "a")
    run.until_fact(1, "1")


def test_a_broker_that_was_killed_and_is_back(run: AtSite, site: TlsSite) -> None:
    site.broker.kill()
    run.until_fact(0, None)
    site.broker.start()
    run.until_fact(0, "a")
    run.until_fact(1, "1")


def test_stop_needs_no_broker(run: AtSite, standing: Standing, site: TlsSite) -> None:
    standing.spoilt = True
    site.broker.freeze()
    run.dispatcher.stop()
    run.tick()
    site.broker.thaw()
    assert run.dispatcher.phase == "stopped"


# Brokers that lie.


def _refused(site: TlsSite) -> str:
    run = AtSite(site)
    run.dispatcher.close()
    assert run.dispatcher.finished
    return run.dispatcher.status.sentence


def test_a_broker_of_another_authority(site: TlsSite, tmp_path: Path) -> None:
    port = free_port()
    other = make_site(tmp_path / "other", port=port)
    liar = Broker(tmp_path, port, other.configuration)
    site.bind(port)
    try:
        assert "its certificate is not accepted: self-signed certificate" in _refused(site)
    finally:
        liar.kill()


@pytest.mark.parametrize(
    ("days", "ago", "hosts", "words"),
    [
        (1, 9, ("localhost",), "certificate has expired"),
        (1, 0, ("elsewhere.example",), "Hostname mismatch"),
        (1, 0, (), "unsuitable certificate purpose"),
    ],
    ids=["expired", "name", "node"],
)
def test_a_broker_with_a_wrong_certificate(
    site: TlsSite, tmp_path: Path, days: int, ago: int, hosts: tuple[str, ...], words: str
) -> None:
    port = free_port()
    shown = site.issue("broker", days, ago, hosts)
    text = site.made.configuration.read_text("utf-8").replace(str(site.port), str(port))
    text = text.replace(str(site.keys / "broker.pem"), str(shown.certificate))
    config = tmp_path / "lie.conf"
    config.write_text(text.replace(str(site.keys / "broker.key"), str(shown.key)), "utf-8")
    liar = Broker(tmp_path, port, config)
    site.bind(port)
    try:
        assert words in _refused(site)
    finally:
        liar.kill()


def test_studio_with_an_expired_certificate(site: TlsSite) -> None:
    old = site.issue("studio", days=1, ago=9)
    assert old.certificate is not None
    assert old.key is not None
    text = f'authority = "authority.pem"\ncertificate = "{old.certificate.name}"\n'
    (site.keys / "old.toml").write_text(f'{text}key = "{old.key.name}"\n', "utf-8")
    with pytest.raises(RunRefused, match="has expired on"):
        site.login("old")


def test_studio_with_a_certificate_of_nobody(site: TlsSite, tmp_path: Path) -> None:
    """The broker ends the connection, and the run says so."""
    other = make_site(tmp_path / "other").site.folder / "keys"
    kept = {name: (site.keys / name).read_bytes() for name in ("studio.pem", "studio.key")}
    site.bind(site.port)
    try:
        for name in kept:
            (site.keys / name).write_bytes((other / name).read_bytes())
        assert "it does not accept this login" in _refused(site)
    finally:
        for name, raw in kept.items():
            (site.keys / name).write_bytes(raw)


# Passwords.


def test_a_password_for_each_node(tmp_path: Path) -> None:
    """The right one is let in and keeps to its topics, a wrong one is not."""
    site = TlsSite(tmp_path / "words", login="password")
    eye = Voice(site, site.login("eye"), "eye")
    (site.keys / "clamp.password").write_text("guessed", "utf-8")
    guess = Voice(site, site.login("clamp"), "clamp")
    try:
        assert eye.answer() == ""
        eye.say(FORCE, 20.0)
        assert eye.acknowledged() == "Not authorized"
        assert guess.answer() == "Not authorized"
    finally:
        eye.close()
        guess.close()
        site.broker.kill()
