"""Write resources/smsl.schema.json from the model: ``.venv/bin/python packaging/schema.py``."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.blueprint.schema import schema_text

FILE = Path(__file__).parent.parent / "resources" / "smsl.schema.json"

if __name__ == "__main__":
    FILE.write_text(schema_text(), encoding="utf-8")
    print(FILE)
