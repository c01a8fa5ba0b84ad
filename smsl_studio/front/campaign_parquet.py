"""The rows of a campaign as Apache Parquet, which programs for statistics read.

Each row has the columns of the JSON. ``runs``, ``reached`` and ``digest`` of the whole campaign
are in the metadata of the file.
"""

from __future__ import annotations

from dataclasses import asdict, fields
from io import BytesIO
from typing import Any

from smsl_studio.errors import UsageError
from smsl_studio.front.campaigns import Campaign, CampaignRow


def require_parquet() -> None:
    """Raise UsageError if the extra is not installed, before a long campaign begins."""
    _pyarrow()


def as_parquet(done: Campaign) -> bytes:
    """Return a campaign as the bytes of a Parquet file. UsageError without the extra."""
    pyarrow, parquet = _pyarrow()
    kinds = {"int": pyarrow.int64(), "float": pyarrow.float64()}
    told = {"runs": f"{done.runs}", "reached": f"{done.reached}", "digest": done.digest}
    schema = pyarrow.schema(
        [(one.name, kinds.get(str(one.type), pyarrow.string())) for one in fields(CampaignRow)],
        metadata=told,
    )
    rows = [{name: _told(value) for name, value in asdict(row).items()} for row in done.rows]
    written = BytesIO()
    parquet.write_table(pyarrow.Table.from_pylist(rows, schema=schema), written)
    return written.getvalue()


def _told(value: Any) -> Any:
    """Return a value that Parquet can hold: half of a character outside of Unicode's first plane
    becomes an escape, as in JSON."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode("utf-8")
    return value


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise UsageError(
            "results as Parquet need the extra parquet",
            advice="Install it: pip install 'smsl-studio[parquet]'.",
        ) from None
    return pyarrow, parquet
