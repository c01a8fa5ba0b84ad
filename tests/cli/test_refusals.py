"""Every refusal code: the shortest way by the command line, from Python and in the window."""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.front.approval_badge import approval_words
from smsl_studio.inspection.approval import rule_code
from smsl_studio.inspection.approval.refusal import CODES
from tests.approval import ADA, DOOR, EVE, entry, register_of, written_policy
from tests.cli.people import Desk
from tests.plugin_folder import LAMP, LAMP_PLUGIN, write_allowed

Way = Callable[[Desk, pytest.MonkeyPatch], tuple[str, ...]]
"""Brings a blueprint into a state, and returns what ``verify`` is called with."""

CHANGED = {"DOOR": {**DOOR["DOOR"], "State_1": {"shut": "State_0"}}}


def digest_differs(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    desk.write(CHANGED)
    return ()


def no_record(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    return ()


def policy_unmet(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.key("ci", "automatic", "ci")
    desk.approve("ci")
    return ()


def key_unknown(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    patch.setenv("SMSL_STUDIO_HOME", str(desk.folder / "another home"))
    return ()


def key_expired(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    public = desk("keys", "show", "ada", "--format", "json").json["public"]
    register = register_of({**entry(ADA, until="2001-01-01"), "keys": [public]})
    return ("--policy", written_policy(desk.folder, "", register))


def key_revoked(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    assert desk("keys", "revoke", "ada", "--why", "it was stolen").status == 0
    return ()


def signature_invalid(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    values = json.loads(desk.record.read_text())
    desk.record.write_text(json.dumps(values, indent=1))
    return ()


def too_few_persons(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    return ("--policy", written_policy(desk.folder, "persons = 2"))


def role_missing(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    return ("--policy", written_policy(desk.folder, "roles = { surgeon = 1 }"))


def record_expired(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    return ("--policy", written_policy(desk.folder, "valid_days = 1e-9"))


def record_revoked(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    made = desk("approve", desk.file, "--key", "ada", "--format", "json").json
    text = f'revoked = ["record:{made["digest"]}"]'
    return ("--policy", written_policy(desk.folder, text))


def rolled_back(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    old = desk.record.read_bytes()
    desk.approve("ada")
    desk.record.write_bytes(old)
    return ()


def verdict_not_approved(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada", "--verdict", "rejected")
    return ()


def condition_unmet(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada", "--condition", "the drill is calibrated")
    return ()


def open_finding(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.write({"DOOR": {**DOOR["DOOR"], "State_1": {"close": "State_9"}}})
    assert desk.approve("ada", "--rule", "R01").status == 0
    return ()


def rules_changed(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    patch.setattr(rule_code, "FRONT", ())
    return ("--policy", written_policy(desk.folder, "rules_unchanged = true"))


def code_missing(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.approve("ada")
    home = Path(str(desk.folder / "home"))
    patch.setenv("SMSL_PLUGIN_PATH", str(home))
    return ("--world", "hanoi")


def code_changed(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    lamp(desk)
    found = desk("check", desk.file, "--world", "lamp", "--format", "json").json["files"][0]
    assert not [one for one in found["findings"] if one["severity"] == "E"], found
    more = tuple(
        word
        for one in found["findings"]
        if one["severity"] == "W"
        for word in ("--disposition", f"{one['rule']}@{one['address']}=it is known")
    )
    answer = desk.approve("ada", "--world", "lamp", *more)
    assert answer.status == 0, answer.err
    assert desk.verify("--world", "lamp").status == 0
    write_more(desk)
    return ("--world", "lamp")


def lamp(desk: Desk) -> None:
    """A blueprint whose operations the world lamp can carry out."""
    values = {"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}
    desk.write(values)
    write_allowed(home_of(), "lamp", LAMP_PLUGIN)


def home_of() -> Path:
    from smsl_studio.home import user_folder

    return user_folder()


def write_more(desk: Desk) -> None:
    """Change the code of the world, and allow it again."""
    from smsl_studio.library.permission import allow
    from tests.plugin_folder import found_plugin

    file = home_of() / "plugins" / "lamp" / "plugin.py"
    file.write_text(file.read_text() + "\n# another version\n")
    allow(found_plugin("lamp"))


def sub_not_covered(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    desk.write({"PART": DOOR["DOOR"]}, "part.json")
    desk.write({"_imports": ["part.json"], **DOOR})
    desk.approve("ada", "--relies-on", str(desk.folder / "part.json"))
    return ()


def policy_invalid(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    return ("--policy", written_policy(desk.folder, "person = 2"))


def register_invalid(desk: Desk, patch: pytest.MonkeyPatch) -> tuple[str, ...]:
    register = register_of(entry(ADA), by=ADA)
    return ("--policy", written_policy(desk.folder, "", register, by=EVE))


WAYS: tuple[Way, ...] = (
    digest_differs,
    no_record,
    policy_unmet,
    key_unknown,
    key_expired,
    key_revoked,
    signature_invalid,
    too_few_persons,
    role_missing,
    record_expired,
    record_revoked,
    rolled_back,
    verdict_not_approved,
    condition_unmet,
    open_finding,
    rules_changed,
    code_missing,
    code_changed,
    sub_not_covered,
    policy_invalid,
    register_invalid,
)
IN_RUNS = (
    "start_unconfirmed",
    "sensor_missing",
    "supervisor_missing",
    "log_unwritable",
    "file_changed",
)
"""Those that only a run can give; tests/front/test_trusted_runs.py has their ways."""
BADGES = {
    "digest_differs": "Changed since signed",
    "no_record": "Uninspected",
    "policy_unmet": "Not approved",
    "key_unknown": "Unknown key",
    "key_expired": "Expired",
    "key_revoked": "Revoked",
    "signature_invalid": "Signature invalid",
    "too_few_persons": "Signature missing",
    "role_missing": "Signature missing",
    "record_expired": "Expired",
    "record_revoked": "Revoked",
    "rolled_back": "Older record",
    "verdict_not_approved": "Rejected",
    "condition_unmet": "Approved with conditions",
    "open_finding": "Open error",
    "rules_changed": "Rules changed",
    "sub_not_covered": "Part not approved",
    "policy_invalid": "Policy invalid",
    "register_invalid": "Register invalid",
}
"""What the badge of the window says, under the policy that is chosen there."""
AT_PLAY = {
    "code_missing", "code_changed", "start_unconfirmed", "sensor_missing", "log_unwritable",
    "file_changed",
}  # fmt: skip
"""Those that the window has when a run begins: the badge asks about no world, and nothing runs
yet. tests/studio/running/test_run_opener.py has their ways."""
NOT_IN_WINDOW = {"supervisor_missing"}
"""The person at the window supervises each of its runs."""


def test_every_code_has_its_way() -> None:
    assert {way.__name__ for way in WAYS} | set(IN_RUNS) == set(CODES)
    in_window = [*BADGES, *AT_PLAY, *NOT_IN_WINDOW]
    assert sorted(in_window) == sorted(CODES)


def test_the_page_says_how_each_code_is_had() -> None:
    page = (Path(__file__).parents[2] / "docs" / "approval.md").read_text("utf-8")
    rows = [line.split("|") for line in page.splitlines() if line.startswith("| `")]
    found = {row[1].strip(" `"): row for row in rows if len(row) == 6}
    assert set(found) == set(CODES)
    for code, row in found.items():
        said = BADGES.get(code, "at Play" if code in AT_PLAY else "never")
        assert row[4].strip() == said, f"| `{code}` | ... | {said} |"


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
def test_a_code_by_the_command_line_and_from_python(
    way: Way, desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = way(desk, monkeypatch)
    code = way.__name__
    assert code in desk.codes(*words)
    given = dict(zip(words[::2], words[1::2], strict=True))
    found = smsl.verify_approval(
        smsl.read(desk.file), policy=given.get("--policy"), world=given.get("--world")
    )
    assert code in [one.code for one in found.refusals]
    if "--world" not in given:
        policy = given.get("--policy")
        said = approval_words(smsl.read(desk.file), Path(policy) if policy else None)
        assert said.words == BADGES[code]
        assert said.advice
        told = [one for one in found.refusals if one.code == code]
        assert code == "no_record" or set(told) & set(said.refusals)
        assert all(f"({one.code})" in " ".join(said.lines) for one in said.refusals)
    text = desk("verify", desk.file, *words)
    assert text.status == 1
    assert f" {code}: " in text.out
    if "--world" not in given:
        _, end = desk.run("--record", str(desk.record), *words)
        assert end["reason"] == "refused"
        assert code in [one["code"] for one in end["refusals"]]


def test_the_clock_is_a_value_that_is_handed_in(desk: Desk) -> None:
    desk.approve("ada", "--expires", "2999-01-31")
    blueprint = smsl.read(desk.file)
    late = datetime(2999, 2, 1, tzinfo=UTC)
    assert [one.code for one in smsl.verify_approval(blueprint, now=late).refusals] == [
        "record_expired",
        "too_few_persons",
    ]
    early = datetime.now(UTC) - timedelta(hours=1)
    found = smsl.verify_approval(blueprint, now=early)
    assert found.refusals[0].code == "signature_invalid"
    backwards = smsl.ApprovalRequest(blueprint, "ada", b"correct horse", now=early)
    with pytest.raises(smsl_error(), match="the clock says"):
        smsl.approve(backwards)


def smsl_error() -> type[Exception]:
    from smsl_studio.errors import ApprovalRefused

    return ApprovalRefused
