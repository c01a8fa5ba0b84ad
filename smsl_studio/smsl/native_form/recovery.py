"""What can be saved of a faulty text."""

from __future__ import annotations

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.native_form.parser import NativeParser, parse
from smsl_studio.smsl.native_form.refusals import form_within
from smsl_studio.smsl.native_form.writer import write


def recover(text: str, file: str) -> Document:
    """A document of its own with everything that could be read of a faulty text.

    Of a text that is in another form, what can be read there.
    """
    parser = NativeParser(text, file)
    form = form_within(text) if len(parser.faults) else ""
    if form:
        try:
            return parse(write(form_named(form).recover(text, file).values), file)
        except ConvertError:
            pass  # There is something in it that has no spelling here: what a native reader saw.
    return parse(write(parser.values), file)
