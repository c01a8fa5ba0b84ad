"""The declared answers of a run's child: one line for each verb, one line for each field.

Edges and facts of the blueprint, and sensors of the opened world, are sent as numbers that both
sides know. So an answer cannot name anything else.
"""

from __future__ import annotations

from typing import Any

from smsl_studio import errors
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.predicates.predicate_text import LONGEST as LONGEST_PREDICATE
from smsl_studio.blueprint.predicates.units import LONGEST as LONGEST_UNIT
from smsl_studio.errors import StudioError
from smsl_studio.host.brief import FAR, VALUE
from smsl_studio.host.codec import (
    Codec,
    Unfit,
    exactly,
    flag,
    nothing,
    number,
    numbers,
    one_of,
    text,
    whole,
)
from smsl_studio.host.compound import mapped, mapping, optional, record, row, several
from smsl_studio.host.cost_functions import MOST as MOST_COST
from smsl_studio.host.protocol import Bound, OpenedWorld, Outcome, Priced, SensorInfo, Tick
from smsl_studio.host.vocabulary import COUNT, NAME, PATIENCE, PLACE, SECONDS, sentence
from smsl_studio.library.operation_library import STOP_MODES
from smsl_studio.monitor.aggregate import MODES, FactRule
from smsl_studio.monitor.sample import BAD, GOOD, UNCERTAIN, Sample
from smsl_studio.world.protocol import Shape

MOST_SENSORS = MOST_FAULTS = 100_000
MOST_SHAPES, MOST_CORNERS = 10_000, 2**22
MOST_LATE = 10_000
"""The largest number of delayed samples in one tick, beside one sample of every sensor."""


POSES = numbers(-FAR, FAR, 7 * MOST_SHAPES)
STATUS = mapping(text(100), text(300), 20)

_KINDS = [kind for kind in vars(errors).values() if isinstance(kind, type)]
REFUSED: Codec[StudioError] = mapped(
    row(
        one_of([kind for kind in _KINDS if issubclass(kind, StudioError)]),
        sentence(6000),
        optional(PLACE),
        sentence(6000),
    ),
    lambda error: (type(error), error.sentence, error.place, error.advice),
    lambda told: told[0](*told[1:]),
)
CRASHED = sentence(6000)
LOADS = sentence(200)
"""The name of the plugin that the child loads now."""

SHAPE = record(
    Shape,
    name=text(1000),
    mesh=numbers(-FAR, FAR, MOST_CORNERS, multiple=9),
    colour=row(*[number(0.0, 1.0)] * 3),
    label=text(1000),
)


class RunAnswers:
    """The codecs of the answers for one blueprint, by verb. ``Host`` explains their meaning.

    ``tick`` and ``sense`` are added when the world is opened.
    """

    def __init__(self, *blueprints: Blueprint) -> None:
        branches = [branch for blueprint in blueprints for branch in blueprint]
        edges = [edge.address for branch in branches for edge in branch.edges()]
        digits = [(branch.name, at) for branch in branches for at in range(branch.num_facts)]
        edge, fact, facts = one_of(edges), one_of(digits), frozenset(digits)
        bound = record(
            Bound,
            function=NAME,
            exact=flag(),
            stop=one_of(STOP_MODES),
            timeout=PATIENCE,
            resumes=flag(),
            touches=several(fact, 10_000),
            generated=flag(),
        )
        sensor = record(
            SensorInfo,
            ("remote",),
            name=NAME,
            branch=one_of([branch.name for branch in branches]),
            digit=whole(0, max((branch.num_facts for branch in branches), default=0)),
            period=PATIENCE,
            max_age=PATIENCE,
            aggregation=one_of([*MODES, "human"]),
            words=mapping(text(1000), sentence(200), 1000),
            unit=text(LONGEST_UNIT),
            predicate=mapping(text(1000), text(LONGEST_PREDICATE), 64),
        )

        def known(told: SensorInfo) -> SensorInfo:
            """Return the sensor unchanged. Unfit if the blueprint does not have its fact."""
            if (told.branch, told.digit) not in facts:
                raise Unfit(f"reads {told.branch}/{told.digit}, which is no fact")
            return told

        rule = record(
            FactRule,
            ("sense",),
            aggregation=one_of([*MODES, "human"]),
            k=optional(COUNT),
            critical=flag(),
            conflict_after=PATIENCE,
            sensors=several(text(1000), 1000),
            max_age=optional(PATIENCE),
            shared=flag(),
        )
        opened = record(
            OpenedWorld,
            ("remote",),
            world=text(1000),
            tick=number(1e-9, 1e3),
            hardware=flag(),
            bound=mapping(edge, bound, len(edges), few=True),
            sensors=several(mapped(sensor, known, known), MOST_SENSORS),
            shapes=several(SHAPE, MOST_SHAPES),
            settle=SECONDS,
            faults=several(sentence(), MOST_FAULTS),
            rules=mapping(fact, rule, len(digits)),
            world_faults=several(NAME, 1000),
            priced=flag(),
            guarded=flag(),
        )
        priced = record(
            Priced,
            costs=mapping(edge, optional(number(0.0, MOST_COST)), len(edges)),
            faults=several(sentence(), 1000),
            closed=mapping(edge, sentence(), len(edges)),
        )
        self.of: dict[str, Codec[Any]] = {
            "warm": nothing(),
            "prepare": nothing(),
            "close": nothing(),
            "open": mapped(row(opened, STATUS, POSES), _drawn, _drawn),
            "begin": nothing(),
            "cancel": nothing(),
            "disturb": several(NAME, MOST_SENSORS),
            "inject": nothing(),
            "costs": priced,
            "suppose": nothing(),
            "extend": row(optional(bound), flag()),
        }

    def opened(self, opened: OpenedWorld) -> None:
        """From now on accept samples from the sensors of this world only."""
        sensors = [(one.branch, one.digit, one.name) for one in opened.sensors]
        sample: Codec[Sample] = mapped(
            row(
                one_of(sensors),
                optional(text(VALUE)),
                SECONDS,
                COUNT,
                COUNT,
                sentence(6000),
                one_of((GOOD, UNCERTAIN, BAD)),
            ),
            lambda said: (said[:3], *said[3:9]),
            lambda told: Sample(*told[0], *told[1:]),
        )
        samples = several(sample, len(sensors) + MOST_LATE)
        tick = record(
            Tick,
            time=SECONDS,
            outcome=one_of(list(Outcome)),
            samples=samples,
            message=sentence(6000),
        )
        poses = exactly(-FAR, FAR, 7 * len(opened.shapes))
        self.of |= {"sense": samples, "tick": row(tick, optional(STATUS), optional(poses))}


def _drawn(told: tuple[Any, ...]) -> tuple[Any, ...]:
    opened, _, poses = told
    if len(poses) != 7 * len(opened.shapes):
        raise Unfit(f"draws {len(opened.shapes)} shapes with {len(poses)} numbers, not 7 each")
    return told
