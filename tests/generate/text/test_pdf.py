"""Texts in PDFs: citations have a page, and a PDF that is a bomb is one sentence."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.generate.text.expert_text import text_at
from smsl_studio.generate.text.step_reader import read_steps


def pdf(contents: list[bytes]) -> bytes:
    """A PDF with a page for each content stream (compressed)."""
    many = len(contents)
    pages = " ".join(f"{3 + 2 * at} 0 R" for at in range(many))
    parts = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{pages}] /Count {many} >>".encode(),
    ]
    font = b"/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>"
    for at, content in enumerate(contents):
        page = f"<< /Type /Page /Parent 2 0 R /Contents {4 + 2 * at} 0 R /Resources << ".encode()
        parts.append(page + font + b" >> >>")
        size = f"<< /Length {len(content)} /Filter /FlateDecode >>\nstream\n".encode()
        parts.append(size + content + b"\nendstream")
    out, places = b"%PDF-1.4\n", []
    for number, part in enumerate(parts, 1):
        places.append(len(out))
        out += f"{number} 0 obj\n".encode() + part + b"\nendobj\n"
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    head = f"xref\n0 {len(parts) + 1}\n0000000000 65535 f \n{table}"
    tail = f"trailer << /Size {len(parts) + 1} /Root 1 0 R >>\nstartxref\n{len(out)}\n%%EOF\n"
    return out + head.encode() + tail.encode()


def page(*lines: str) -> bytes:
    """The content stream of a page with some lines of text."""
    told = "".join(f"({line}) Tj 0 -20 Td " for line in lines)
    return zlib.compress(f"BT /F1 12 Tf 50 700 Td {told} ET".encode())


def test_a_citation_of_a_pdf_has_its_page(tmp_path: Path) -> None:
    file = tmp_path / "lamp.pdf"
    file.write_bytes(pdf([page("A lamp"), page("1. Plug it in.", "2. Switch it on.")]))
    text = text_at(file)
    steps = read_steps([text]).steps
    assert [step.do for step in steps] == ["Plug it in", "Switch it on"]
    source = steps[1].sources[0].citation
    assert (source.page, source.words) == (2, "Switch it on.")
    assert text.has(source)


@pytest.mark.parametrize(
    "raw",
    [
        lambda: b"%PDF-1.4\nno",
        lambda: b"",
        lambda: pdf([zlib.compress(b"0" * 200_000_000, 9)]),
        lambda: pdf([page("a")]).replace(b"/Kids [3 0 R]", b"/Kids [2 0 R]"),
    ],
    ids=["broken", "empty", "bomb", "circle"],
)
def test_a_pdf_that_cannot_be_read_is_one_sentence(
    raw: Callable[[], bytes], tmp_path: Path
) -> None:
    file = tmp_path / "bad.pdf"
    file.write_bytes(raw())
    with pytest.raises(ReadError, match=r"bad\.pdf:1:1: the (PDF cannot be read|text is empty)"):
        text_at(file)
