"""The provider ``reader``: answers without a model."""

from __future__ import annotations

import json

from smsl_studio.generate.text.equipment_reader import read_equipment
from smsl_studio.generate.text.prompts import HIM, PM, RMM
from smsl_studio.generate.text.provider import Matter, StageAnswer, StageQuestion
from smsl_studio.generate.text.serialization import blueprint_values
from smsl_studio.generate.text.step_numbers import numbered
from smsl_studio.generate.text.step_reader import read_steps


class TextReader:
    """Reads structured text. The same text gives the same answers, and nothing leaves this
    machine."""

    by_file = False
    attempts = 1
    name = "reader"

    def answer(self, question: StageQuestion) -> StageAnswer:
        """Return the answer of a stage. ReadError for a text without steps."""
        return StageAnswer(self._text(question.stage, question.matter), self.name)

    def _text(self, stage: str, matter: Matter) -> str:
        if stage == RMM:
            return '{"functions": []}'
        if stage == PM:
            return numbered(read_steps(matter.texts)).model_dump_json(exclude_defaults=True)
        procedure = matter.procedure
        if procedure is None:
            raise ValueError("the steps come first")
        if stage == HIM:
            found = read_equipment(procedure, matter.texts, matter.hardware)
            return found.model_dump_json(exclude_defaults=True)
        equipment = matter.equipment
        sensors = equipment.sensors() if equipment is not None else {}
        return json.dumps(blueprint_values(procedure, sensors), ensure_ascii=False)
