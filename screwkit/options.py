"""The options that commands share, each with its spelling and its sentence of help."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


class Order(StrEnum):
    """Which half of a screw is printed first."""

    DIRECTION = "direction"
    LINEAR = "linear"


class Best(StrEnum):
    """Which value of a sweep is refined."""

    LEAST = "least"
    GREATEST = "greatest"


class Format(StrEnum):
    """What a report is written as."""

    LATEX = "latex"
    PDF = "pdf"
    HTML = "html"


class Which(StrEnum):
    """Whose JSON Schema is wanted."""

    BOTH = "both"
    MECHANISM = "mechanism"
    RESULTS = "results"


CaseName = Annotated[str, typer.Argument(metavar="CASE", help="File or bundled case.")]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON document.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no notes.")]
Variant = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="A variant that the file declares."),
]
Setting = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="A number for a symbol."),
]
Actuated = Annotated[
    str | None,
    typer.Option(metavar="1,2,3,7", help="Replaces the declared actuated joints."),
]
Timeout = Annotated[
    float | None,
    typer.Option(metavar="SECONDS", min=0.0, help="Give up after this long."),
]
Memory = Annotated[
    float | None,
    typer.Option(
        metavar="GB",
        min=0.1,
        help="Address space for the exact work; three quarters of the memory if not "
        "given.",
    ),
]
Every = Annotated[bool, typer.Option("--all", help="Print lists in full.")]
At = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME=VALUE", help="Posture: joint variables and symbols."),
]
CertificateFile = Annotated[
    Path | None,
    typer.Option(
        "--certificate",
        metavar="FILE",
        help="Write proofs of the lists, for `screwkit verify`.",
    ),
]
Strata = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        min=1,
        help="What happens where up to N of the conditions hold together.",
    ),
]
Body = Annotated[
    str | None,
    typer.Option(metavar="LINK", help="The twists of this body instead."),
]
RelativeTo = Annotated[
    str | None,
    typer.Option(metavar="LINK", help="Relative to this body; the base by default."),
]
Length = Annotated[
    str | None,
    typer.Option(metavar="L", help="A length that counts as one radian."),
]
Draw = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="A picture too: .pdf, .svg or .png."),
]
Open = Annotated[bool, typer.Option("--open", help="Show it in a browser at once.")]
Size = Annotated[int | None, typer.Option(min=0, help="Actuated freedoms in a scheme.")]
Candidates = Annotated[
    str | None, typer.Option(metavar="1,2,3", help="Freedoms to choose from.")
]
Work = Annotated[
    int | None,
    typer.Option(metavar="TERMS", min=0, help="Expand no more for loci than this."),
]
Balanced = Annotated[
    bool, typer.Option("--balanced", help="Same number from every limb.")
]
Add = Annotated[
    bool,
    typer.Option(
        "--add", help="Which added actuators remove which singularities of the scheme."
    ),
]
Rank = Annotated[
    int | None,
    typer.Option(
        metavar="POSTURES",
        min=1,
        help="Order schemes by their conditioning over so many postures.",
    ),
]
Within = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME=A:B", help="Draw these postures from a range; repeatable."
    ),
]
Limits = Annotated[
    list[str] | None,
    typer.Option(
        "--within", metavar="NAME=A:B", help="Limits of distances; repeatable."
    ),
]
SchemesFile = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="Write .tex, .csv, .json or .txt."),
]
MapFile = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="Write .csv, .npz or a .pdf map."),
]
ReportPlace = Annotated[
    Path | None, typer.Option("-o", "--output", help="File or folder.")
]
ScrewOrder = Annotated[Order, typer.Option(help="linear prints (v; ω) and (m; f).")]
Form = Annotated[Format, typer.Option("--format", help="What to write.")]
Point = Annotated[
    str | None,
    typer.Option(metavar="X,Y,Z", help="Where the reference point is wanted."),
]
Turn = Annotated[
    list[str] | None,
    typer.Option(
        metavar="LINK=ANGLE",
        help="By which angle, in space by which rotation vector x,y,z, a link is "
        "turned from the posture of the file; repeatable.",
    ),
]
Vary = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME=A:B:COUNT", help="A range of a symbol; repeatable."),
]
SlicePicture = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="Draw the slice: .pdf, .svg or .png."),
]
Distant = Annotated[
    bool,
    typer.Option(
        "--distance",
        help="How far the posture is from the nearest of each kind.",
    ),
]
Slice = Annotated[
    list[str] | None,
    typer.Option(
        "--slice",
        metavar="NAME=A:B",
        help="A range of one of the two symbols of a slice; all others have their "
        "values. A third number counts the steps.",
    ),
]
Index = Annotated[
    str,
    typer.Option(
        help="kinematic or force with .min .max .condition .product .misfit; "
        "locus; sigma_min."
    ),
]
Samples = Annotated[
    int | None, typer.Option(min=1, help="So many points of the box, no grid.")
]
Refined = Annotated[
    Best | None, typer.Option("--best", help="Refine the least or the greatest value.")
]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes on this machine.")]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Of a Dask cluster.")
]
