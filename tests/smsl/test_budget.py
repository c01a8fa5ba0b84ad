"""A short text that stands for very many values is refused at once."""

from __future__ import annotations

import json

import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document.limits import (
    CHARACTERS_A_VALUE,
    FREE_VALUES,
    MAX_BRANCHES,
    most_values,
)
from smsl_studio.smsl.forms import form_named

FORMS = ("json", "smsl", "yaml")


def notes(form: str, value: str, count: int) -> str:
    """A blueprint of one SB with a note that is a list of so many values."""
    listed = ",".join([value] * count)
    if form == "smsl":
        return f"{{\n# NAME: SB\n# _note: [{listed}]\nA: [ ]\n}}\n"
    return f'{{"SB": {{"_note": [{listed}], "A": {{}}}}}}'


@pytest.mark.parametrize("form", FORMS)
def test_a_short_text_may_not_stand_for_very_many_values(form: str) -> None:
    most = FREE_VALUES * 2
    with pytest.raises(ReadError) as caught:
        form_named(form).parse(notes(form, "1", most), f"f.{form}")
    error = caught.value
    assert "names and values stand in" in error.sentence
    assert "characters" in error.sentence
    assert error.place is not None
    assert error.place.column > most_values(notes(form, "1", most))
    assert error.advice


@pytest.mark.parametrize("form", FORMS)
def test_what_is_as_long_as_its_values_ask_for_is_read(form: str) -> None:
    text = notes(form, '"' + "v" * CHARACTERS_A_VALUE + '"', FREE_VALUES * 2)
    document = form_named(form).parse(text, f"f.{form}")
    assert len(document.values["SB"]["_note"]) == FREE_VALUES * 2


@pytest.mark.parametrize("form", FORMS)
def test_a_small_text_may_be_as_dense_as_it_likes(form: str) -> None:
    document = form_named(form).parse(notes(form, "1", FREE_VALUES - 10), f"f.{form}")
    assert len(document.values["SB"]["_note"]) == FREE_VALUES - 10


@pytest.mark.parametrize("form", FORMS)
def test_a_blueprint_has_so_many_branches_and_no_more(form: str) -> None:
    def written(count: int) -> str:
        values: dict[str, object] = {f"Branch_{number}": {"A": {}} for number in range(count)}
        if form == "json":
            return json.dumps(values)
        return form_named(form).write(values)

    most = form_named(form).parse(written(MAX_BRANCHES), f"f.{form}")
    assert len(read_blueprint(most).branches) == MAX_BRANCHES
    with pytest.raises(ReadError) as caught:
        read_blueprint(form_named(form).parse(written(MAX_BRANCHES + 1), f"f.{form}"))
    assert caught.value.place is not None
    assert "State Branch" in str(caught.value)
