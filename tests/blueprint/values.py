"""Blueprints of tests, from plain values, in any form."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.json_form import parse_json, write_json


def read(values: Any) -> Blueprint:
    """The blueprint of a file ``f.json`` with these values."""
    return read_blueprint(parse_json(write_json(values), "f.json"))


def in_form(blueprint: Blueprint, form: str) -> Blueprint:
    """The same blueprint, written in a form and read again."""
    text = form_named(form).write(blueprint.document.values)
    return read_blueprint(form_named(form).parse(text, f"f.{form}"))
