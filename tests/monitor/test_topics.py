"""A topic names one fact, with any characters in the names, and has exactly one spelling."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.monitor.topics import FactTopic, StatusTopic, read_topic

names = st.text(st.characters(), min_size=1)


@given(names, names, names, st.integers(0, 999_999), names)
def test_any_names_go_through_a_topic(
    site: str, run: str, branch: str, digit: int, source: str
) -> None:
    for topic in (StatusTopic(site, source), FactTopic(site, run, branch, digit, source)):
        assert read_topic(str(topic)) == topic
        levels = str(topic).split("/")
        assert len(levels) == (6 if isinstance(topic, StatusTopic) else 9)
        assert not set("+#") & set(str(topic))
        assert str(topic).isascii()


def test_how_a_topic_is_written() -> None:
    assert str(StatusTopic("lab", "bench 1")) == "smsl/1/lab/node/bench%201/status"
    written = "smsl/1/lab/run/main/fact/A%2FB%2B%23/2/%C3%A9ye"
    assert str(FactTopic("lab", "main", "A/B+#", 2, "éye")) == written


@pytest.mark.parametrize(
    "topic",
    [
        "",
        "smsl/1",
        "smsl/2/lab/node/n/status",
        "smsl/1/lab/node/n",
        "smsl/1/lab/node/n/status/more",
        "smsl/1/lab/node//status",
        "smsl/1//node/n/status",
        "smsl/1/lab/run/main/fact/SB/0",
        "smsl/1/lab/run/main/fact/SB/0/eye/more",
        "smsl/1/lab/run/main/fact/SB/-1/eye",
        "smsl/1/lab/run/main/fact/SB/00/eye",
        "smsl/1/lab/run/main/fact/SB/1234567/eye",
        "smsl/1/lab/run/main/fact/SB/٣/eye",
        "smsl/1/lab/run/main/fact/SB/x/eye",
        "smsl/1/lab/run/main/fact/S%42/0/eye",
        "smsl/1/lab/run/main/fact/S%2b/0/eye",
        "smsl/1/lab/run/main/fact/S%ff/0/eye",
        "smsl/1/lab/run/main/fact/S B/0/eye",
        "SMSL/1/lab/node/n/status",
    ],
)
def test_what_is_no_topic_of_ours(topic: str) -> None:
    assert read_topic(topic) is None


@given(st.text(st.sampled_from("smsl/1/lab/run/main/fact/node/status%+#0é")))
def test_any_text_is_read_or_refused(topic: str) -> None:
    found = read_topic(topic)
    assert found is None or str(found) == topic
