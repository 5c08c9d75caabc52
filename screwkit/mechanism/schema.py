"""The file format as pydantic models: the one source of reading and of its schema.

Files are read as text throughout, so the models check structure only: which keys there
are, which of them are lists or mappings, which words are allowed.  What the text means
-- expressions, names, geometry -- is decided in `assembly`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    model_validator,
)
from pydantic_core import CoreSchema

from screwkit.mechanism.schema_fields import (
    SCALAR_SCHEMA,
    VECTOR_SCHEMA,
    Flag,
    Formula,
    Formulas,
    Freedoms,
    Vector,
    Version,
    Weight,
    Word,
)


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _ShortEntry(_Entry):
    """An entry that may be written as its main value alone."""

    @classmethod
    def _main_key(cls) -> str:
        raise NotImplementedError

    @classmethod
    def _short_schema(cls) -> dict[str, Any]:
        raise NotImplementedError

    @model_validator(mode="before")
    @classmethod
    def _written_out(cls, value: Any) -> Any:
        return value if isinstance(value, dict) else {cls._main_key(): value}

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        long = handler.resolve_ref_schema(handler(core_schema))
        return {"anyOf": [cls._short_schema(), long]}


class ParameterEntry(_ShortEntry):
    """A symbol that stays a symbol in every derivation.

    Attributes:
        value: For numbers and pictures.
        positive: Assumed > 0.
        nonzero: Assumed ≠ 0.
    """

    value: Formula | None = None
    positive: Flag = False
    nonzero: Flag = False

    @classmethod
    def _main_key(cls) -> str:
        return "value"

    @classmethod
    def _short_schema(cls) -> dict[str, Any]:
        return SCALAR_SCHEMA


class VariableEntry(ParameterEntry):
    """A free symbol that is no joint variable.

    Attributes:
        angle: Whether it is an angle.
    """

    angle: Flag = False


class VectorEntry(_ShortEntry):
    """A named point or vector.

    Attributes:
        link: The body in whose frame the coordinates are; the base if left out.
        at: Coordinates, or an expression of other points and vectors.
    """

    link: Word | None = None
    at: Vector

    @classmethod
    def _main_key(cls) -> str:
        return "at"

    @classmethod
    def _short_schema(cls) -> dict[str, Any]:
        return VECTOR_SCHEMA


class MdhEntry(_Entry):
    """A row of a Khalil-Kleinfinger table; what is missing is 0."""

    gamma: Formula = "0"
    b: Formula = "0"
    alpha: Formula = "0"
    d: Formula = "0"
    theta: Formula = "0"
    r: Formula = "0"


class _JointEntry(_Entry):
    name: Word
    parent: Word
    child: Word
    variable: Formulas | None = None
    offset: Formulas | None = None
    actuated: Freedoms | None = None
    point: Vector | None = None


class LineJointEntry(_JointEntry):
    """A joint about or along one axis."""

    type: Literal["revolute", "prismatic", "cylindrical"]
    axis: Vector | None = None
    mdh: MdhEntry | None = None


class HelicalJointEntry(_JointEntry):
    """A joint that advances along its axis as it turns."""

    type: Literal["helical"]
    axis: Vector | None = None
    pitch: Formula | None = None
    mdh: MdhEntry | None = None


class UniversalJointEntry(_JointEntry):
    """Two axes that meet: one fixed in the parent, one in the child."""

    type: Literal["universal"]
    axes: tuple[Vector, Vector] | None = None
    mdh: MdhEntry | None = None


class SphericalJointEntry(_JointEntry):
    """Rotations about a centre."""

    type: Literal["spherical"]
    mdh: MdhEntry | None = None


class PlanarJointEntry(_JointEntry):
    """Motions in a plane."""

    type: Literal["planar"]
    normal: Vector | None = None
    mdh: MdhEntry | None = None


class FixedJointEntry(_JointEntry):
    """A rigid connection."""

    type: Literal["fixed", "complete"]
    normal: Vector | None = None
    mdh: MdhEntry | None = None


class ContactEntry(_JointEntry):
    """A contact with a normal."""

    type: Literal["point", "hard_finger", "soft_finger", "plane"]
    normal: Vector | None = None


class LineContactEntry(_JointEntry):
    """A contact along a line."""

    type: Literal["line", "line_friction"]
    normal: Vector | None = None
    line: Vector | None = None


JointEntry: TypeAlias = Annotated[
    LineJointEntry
    | HelicalJointEntry
    | UniversalJointEntry
    | SphericalJointEntry
    | PlanarJointEntry
    | FixedJointEntry
    | ContactEntry
    | LineContactEntry,
    Field(discriminator="type"),
]


class RotationEntry(_Entry):
    """One of: axis and angle; euler and angles; quaternion."""

    axis: Vector | None = None
    angle: Formula | None = None
    euler: Word | None = None
    angles: Formulas | None = None
    quaternion: Formulas | None = None


class PoseEntry(_Entry):
    """Where the platform's frame stands in a `posture` file."""

    translation: Vector | None = None
    rotation: RotationEntry | None = None


class WeightsEntry(_Entry):
    """Diagonals or full matrices for metric results."""

    twist: Weight | None = None
    rates: Weight | None = None
    wrench: Weight | None = None
    torques: Weight | None = None
    contact_forces: Weight | None = None


class ClaimEntry(_Entry):
    """An expected value and where it comes from."""

    value: Any
    source: Word
    status: Literal["published", "derived", "regression"]
    holds: Flag = True
    note: str = ""
    tolerance: Formula | None = None


class VariantEntry(_Entry):
    """The same mechanism at other values of its symbols, with claims of its own.

    Attributes:
        title: In words.
        values: Closed expressions for declared parameters and variables.
        expected: Claims that hold at these values, in the place of the file's own.
    """

    title: str = ""
    values: dict[str, Formula]
    expected: dict[str, ClaimEntry] = Field(default_factory=dict)


class MechanismEntry(_Entry):
    """A mechanism file."""

    screwkit: Version
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]+$", max_length=80)]
    title: str = ""
    source: str = ""
    known_for: str = ""
    units: str = ""
    space: Literal["spatial", "planar"] = "spatial"
    geometry: Literal["posture", "reference", "mdh"]
    base: Word
    platform: Word
    links: Annotated[tuple[Word, ...], Field(min_length=1)]
    parameters: dict[str, ParameterEntry] = Field(default_factory=dict)
    variables: dict[str, VariableEntry] = Field(default_factory=dict)
    points: dict[str, VectorEntry] = Field(default_factory=dict)
    vectors: dict[str, VectorEntry] = Field(default_factory=dict)
    pose: PoseEntry | None = None
    joints: tuple[JointEntry, ...]
    actuated: tuple[Word, ...] | None = None
    reference_point: Vector | None = None
    weights: WeightsEntry | None = None
    limbs: dict[str, tuple[Word, ...]] = Field(default_factory=dict)
    expected: dict[str, ClaimEntry] = Field(default_factory=dict)
    variants: dict[str, VariantEntry] = Field(default_factory=dict)


def json_schema() -> dict[str, Any]:
    """The JSON Schema of a mechanism file, generated from the models."""
    schema = MechanismEntry.model_json_schema()
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "screwkit mechanism file",
        **{key: value for key, value in schema.items() if key != "title"},
    }
