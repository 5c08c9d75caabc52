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
    PlainValidator,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import CoreSchema, PydanticCustomError

from screwkit.conventions import FORMAT_VERSION

_SCALAR: dict[str, Any] = {"type": ["string", "number"]}
_VECTOR: dict[str, Any] = {
    "anyOf": [
        {"type": "string"},
        {"type": "array", "items": _SCALAR, "minItems": 2, "maxItems": 3},
    ]
}
_LIST: dict[str, Any] = {"type": "array", "items": _SCALAR}


def _kind(value: object) -> str:
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, dict):
        return "a mapping"
    return f"{value!r}" if value != "" else "nothing"


def _wrong(expected: str, value: object) -> PydanticCustomError:
    return PydanticCustomError(
        "shape",
        "{expected} is expected, but {found} was found",
        {"expected": expected, "found": _kind(value)},
    )


def _formula(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise _wrong("an expression", value)
    return value


def _word(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise _wrong("a name", value)
    return value


def _flag(value: object) -> bool:
    if value not in ("true", "false"):
        raise _wrong("true or false", value)
    return value == "true"


def _formulas(value: object) -> tuple[str, ...]:
    if isinstance(value, str) and value:
        return (value,)
    if not isinstance(value, list) or not all(_is_text(item) for item in value):
        raise _wrong("an expression or a list of them", value)
    return tuple(value)


def _vector(value: object) -> str | tuple[str, ...]:
    if isinstance(value, str) and value:
        return value
    if (
        not isinstance(value, list)
        or len(value) not in (2, 3)
        or not all(_is_text(item) for item in value)
    ):
        if isinstance(value, list):
            raise PydanticCustomError(
                "shape",
                "a vector has three coordinates, but {count} were found",
                {"count": len(value)},
            )
        raise _wrong("a vector [x, y, z] or an expression of named ones", value)
    return tuple(value)


def _matrix(value: object) -> tuple[str, ...] | tuple[tuple[str, ...], ...]:
    if isinstance(value, list) and value:
        if all(_is_text(item) for item in value):
            return tuple(value)
        if all(
            isinstance(row, list)
            and len(row) == len(value)
            and all(_is_text(item) for item in row)
            for row in value
        ):
            return tuple(tuple(row) for row in value)
    raise _wrong("a diagonal (a list) or a square matrix (a list of rows)", value)


def _freedoms(value: object) -> bool | tuple[int, ...]:
    if value in ("true", "false"):
        return value == "true"
    if isinstance(value, list) and all(
        isinstance(item, str) and item.isascii() and item.isdigit() and len(item) < 3
        for item in value
    ):
        return tuple(int(item) for item in value)
    raise _wrong("true, false or a list of freedoms from 0", value)


def _version(value: object) -> int:
    if value != str(FORMAT_VERSION):
        raise PydanticCustomError(
            "version",
            "format version {found} is not known; this screwkit reads version "
            f"{FORMAT_VERSION}: write `screwkit: {FORMAT_VERSION}` or update screwkit",
            {"found": _kind(value)},
        )
    return FORMAT_VERSION


def _is_text(value: object) -> bool:
    return isinstance(value, str) and value != ""


Formula: TypeAlias = Annotated[str, PlainValidator(_formula), WithJsonSchema(_SCALAR)]
Word: TypeAlias = Annotated[
    str, PlainValidator(_word), WithJsonSchema({"type": ["string", "number"]})
]
Flag: TypeAlias = Annotated[
    bool, PlainValidator(_flag), WithJsonSchema({"type": "boolean"})
]
Formulas: TypeAlias = Annotated[
    tuple[str, ...],
    PlainValidator(_formulas),
    WithJsonSchema({"anyOf": [_SCALAR, _LIST]}),
]
Vector: TypeAlias = Annotated[
    str | tuple[str, ...], PlainValidator(_vector), WithJsonSchema(_VECTOR)
]
Weight: TypeAlias = Annotated[
    tuple[str, ...] | tuple[tuple[str, ...], ...],
    PlainValidator(_matrix),
    WithJsonSchema({"anyOf": [_LIST, {"type": "array", "items": _LIST}]}),
]
Freedoms: TypeAlias = Annotated[
    bool | tuple[int, ...],
    PlainValidator(_freedoms),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "boolean"},
                {"type": "array", "items": {"type": "integer", "minimum": 0}},
            ]
        }
    ),
]


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
        return _SCALAR


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
        return _VECTOR


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


class MechanismEntry(_Entry):
    """A mechanism file."""

    screwkit: Annotated[
        int, PlainValidator(_version), WithJsonSchema({"const": FORMAT_VERSION})
    ]
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]+$", max_length=80)]
    title: str = ""
    source: str = ""
    units: str = ""
    space: Literal["spatial", "planar"] = "spatial"
    geometry: Literal["posture", "reference", "mdh"]
    base: Word
    platform: Word
    links: tuple[Word, ...]
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


def json_schema() -> dict[str, Any]:
    """The JSON Schema of a mechanism file, generated from the models."""
    schema = MechanismEntry.model_json_schema()
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "screwkit mechanism file",
        **{key: value for key, value in schema.items() if key != "title"},
    }
