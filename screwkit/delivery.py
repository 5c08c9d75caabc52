"""Answers that go to files: reports and tables of schemes.

Each function returns what the command line calls with the finished answer; it writes
whole files only and says in a line what it wrote.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from screwkit.errors import MissingToolError, ScrewkitError
from screwkit.results.analysis import Analysis
from screwkit.results.manipulability import Manipulability
from screwkit.results.reach import Reach
from screwkit.results.schemes import Ranking, Schemes
from screwkit.results.singularities import Singularities
from screwkit.results.view import View

Certified = TypeVar("Certified", Singularities, Schemes)
Delivery = Callable[[Any], list[str]]


_TABLES = (".tex", ".csv", ".json", ".txt")
_REPORTS = {"latex": ".tex", "pdf": ".pdf", "html": ".html"}


def only_balanced(answer: Schemes) -> Schemes:
    """The same counts, listing only schemes with equal shares of every limb."""
    even = tuple(s for s in answer.schemes if s.balanced)
    order = answer.ranking
    if isinstance(order, Ranking):
        named = {scheme.actuated for scheme in even}
        kept = tuple(one for one in order.schemes if one.actuated in named)
        order = replace(order, schemes=kept)
    return replace(answer, schemes=even, ranking=order)


def changed_schemes(
    certificate: Path | None, *, balanced: bool
) -> Callable[[Schemes], Schemes] | None:
    """What becomes of an answer: its certificate is written, its list made shorter."""
    if certificate is None:
        return only_balanced if balanced else None
    write = written_certificate(certificate)

    def change(answer: Schemes) -> Schemes:
        written: Schemes = write(answer)
        return only_balanced(written) if balanced else written

    return change


def written_certificate(path: Path) -> Callable[[Certified], Certified]:
    """Write the certificate of an answer; the answer then says where it is."""

    def change(answer: Certified) -> Certified:
        from screwkit.reports.output import write  # noqa: PLC0415

        write(path, answer.certificate or "")
        return replace(answer, certificate=str(path))

    return change


def show_all(answer: Schemes | Singularities) -> str:
    """The text with every scheme, or every condition."""
    from screwkit.reports.sections import answer_blocks  # noqa: PLC0415
    from screwkit.reports.text import render  # noqa: PLC0415

    return render(answer_blocks(answer, every=True))


def deliver_schemes(path: Path) -> Delivery:
    """Write schemes by the ending of ``path``: .tex, .csv, .json or .txt.

    Raises:
        ScrewkitError: If the ending is none of these.
    """
    if path.suffix not in _TABLES:
        raise ScrewkitError(f"{path}: schemes are written as {', '.join(_TABLES)}")

    def deliver(answer: Schemes) -> list[str]:
        from screwkit.reports.output import write  # noqa: PLC0415
        from screwkit.reports.records import to_json  # noqa: PLC0415

        match path.suffix:
            case ".json":
                content = json.dumps(to_json(answer), indent=1) + "\n"
            case ".csv":
                content = _csv(answer)
            case ".tex":
                from screwkit.reports.article_schemes import schemes_table  # noqa: PLC0415
                from screwkit.reports.latex import fragment  # noqa: PLC0415

                content = fragment(schemes_table(answer, shown=None))
            case _:
                content = show_all(answer)
        write(path, content)
        return [f"wrote {path}"]

    return deliver


def _csv(answer: Schemes) -> str:
    file = io.StringIO()
    table = csv.writer(file, lineterminator="\n")
    head = ["actuated", "admissible", "generic_rank", "locus", "reason", "proved"]
    ranked: dict[tuple[str, ...], list[float]] = {}
    if isinstance(answer.ranking, Ranking):
        head += ["median", "worst"]
        ranked = {x.actuated: [x.median, x.worst] for x in answer.ranking.schemes}
    unranked = [""] * (len(head) - 6)
    table.writerow(head)
    for scheme in answer.schemes:
        powers = scheme.multiplicities or (1,) * len(scheme.locus)
        locus = " * ".join(
            f"({factor})" + (f"^{power}" if power > 1 else "")
            for factor, power in zip(scheme.locus, powers, strict=True)
        )
        table.writerow(
            [
                " ".join(scheme.actuated),
                "yes" if scheme.admissible else "no",
                scheme.generic_rank,
                locus,
                scheme.reason or "",
                "no" if scheme.undecided or scheme.deeper else "yes",
                *ranked.get(scheme.actuated, unranked),
            ]
        )
    return file.getvalue()


def deliver_picture(path: Path) -> Delivery:
    """Draw the mechanism with its ellipses: .pdf, .svg or .png by the ending.

    Several configurations go to numbered files.

    Raises:
        ScrewkitError: If the ending is none of these.
    """
    from screwkit.reports.figures import FORMS  # noqa: PLC0415

    if path.suffix not in FORMS:
        raise ScrewkitError(f"{path}: a picture is written as {', '.join(FORMS)}")

    def deliver(answer: Manipulability | Reach) -> list[str]:
        from screwkit.reports.draw_print import picture  # noqa: PLC0415
        from screwkit.reports.output import write  # noqa: PLC0415
        from screwkit.reports.panels import panels_of  # noqa: PLC0415

        answers = [answer] if isinstance(answer, Manipulability) else _all(answer)
        said = []
        for number, one in enumerate(answers, 1):
            panels = panels_of(one)
            if not panels:
                return ["no picture: the mechanism has too many joints"]
            name = f"{path.stem}-{number}" if len(answers) > 1 else path.stem
            place = path.with_name(name + path.suffix)
            write(place, picture(panels, FORMS[path.suffix]))
            said.append(f"wrote {place}")
        return said

    return deliver


def _all(answer: Reach) -> list[Manipulability]:
    return list(answer.configurations)


def open_page(answer: View) -> list[str]:
    """Show the page of a view in a browser.

    Raises:
        MissingToolError: If there is no browser.
    """
    import webbrowser  # noqa: PLC0415

    place = Path(answer.file).resolve()
    if not webbrowser.open(place.as_uri()):
        raise MissingToolError(
            f"no browser was found to show {place}; open the file with one, or set "
            f"the environment variable BROWSER"
        )
    return [f"opened {place}"]


def deliver_report(form: str, output: Path | None) -> Delivery:
    """Write a report as ``latex``, ``pdf`` or ``html``.

    Raises:
        ScrewkitError: If the ending of the file is that of another format.
    """
    for other in _REPORTS.keys() - {form}:
        if output is not None and output.suffix.lower() == _REPORTS[other]:
            raise ScrewkitError(
                f"{output}: a report with this ending needs --format {other}, but "
                f"--format is {form}"
            )

    def deliver(answer: Analysis) -> list[str]:
        from screwkit.reports.bundle import write_html, write_latex, write_pdf  # noqa: PLC0415

        match form:
            case "latex":
                return write_latex(answer, output or Path("report.tex"))
            case "pdf":
                return write_pdf(answer, output or Path("report.pdf"))
            case "html":
                return write_html(answer, output or Path("report.html"))
            case _:
                raise ScrewkitError(f"unknown format {form!r}")

    return deliver
