"""The settings of the window; a damaged settings file does no harm."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QByteArray

from smsl_studio.studio.base.settings import RECENT, Settings


def test_choices_are_read_again_from_the_same_folder(home: Path) -> None:
    first = Settings()
    assert first.folder == home
    first.theme = "dark"
    first.store("panels/draw", QByteArray(b"\x00\x01\xff"))
    first.sync()
    again = Settings()
    assert again.theme == "dark"
    assert again.bytes_of("panels/draw").data() == b"\x00\x01\xff"
    assert again.bytes_of("nothing").isEmpty()


def test_recent_files_are_newest_first_and_few(home: Path) -> None:
    settings = Settings()
    assert not settings.recent
    for number in range(RECENT + 3):
        settings.remember(Path(f"/a/{number}.json"))
    settings.remember(Path("/a/5.json"))
    assert settings.recent[0] == Path("/a/5.json")
    assert len(settings.recent) == RECENT
    assert len(set(settings.recent)) == RECENT
    settings.forget(Path("/a/5.json"))
    assert Path("/a/5.json") not in settings.recent


def test_a_recent_file_has_the_time_at_which_it_was_opened(home: Path) -> None:
    settings, path = Settings(), Path("/a/two words.json")
    assert settings.opened(path) is None
    before = datetime.now().astimezone()
    settings.remember(Path("/a/other.json"))
    settings.remember(path)
    settings.sync()
    again = Settings()
    for one in (path, Path("/a/other.json")):
        then = again.opened(one)
        assert then is not None
        assert before <= then <= datetime.now().astimezone()


def test_times_that_do_not_read_are_not_known(home: Path) -> None:
    home.mkdir(parents=True, exist_ok=True)
    (home / "window.ini").write_text("[General]\nrecent=/a.json\nopened=often /a.json\n")
    assert Settings().recent == (Path("/a.json"),)
    assert Settings().opened(Path("/a.json")) is None


def test_an_unknown_theme_means_the_theme_of_the_desktop(home: Path) -> None:
    home.mkdir(parents=True, exist_ok=True)
    (home / "window.ini").write_text("[General]\ntheme=pink\n")
    assert Settings().theme == "system"
