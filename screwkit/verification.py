"""Certificates asked for and checked: files in, answers out."""

from __future__ import annotations

import secrets
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from screwkit.errors import MechanismFileError, ScrewkitError, UndecidedError
from screwkit.progress import Progress, silent
from screwkit.results.verification import Verification, VerifiedPart

if TYPE_CHECKING:
    from screwkit.case import Case
    from screwkit.certificates.findings import Findings
    from screwkit.certificates.records import Certificate, Node, Source
    from screwkit.mechanism.model import Mechanism
    from screwkit.results.schemes import Schemes
    from screwkit.results.singularities import (
        ActuationSingularities,
        ConstraintSingularities,
        LimbSingularities,
        Singularities,
    )

    Listed = LimbSingularities | ConstraintSingularities | ActuationSingularities


class CertificateError(ScrewkitError):
    """A file is no certificate."""


def certified_answer(
    case: Case, answer: Singularities, progress: Progress = silent
) -> Singularities:
    """An answer of `singularities` with its certificate, as the text of its document.

    Each list says whether the certificate carries a proof that it is complete, and is
    called complete only then.

    Args:
        case: As loaded from a file.
        answer: Of this case.
        progress: Told about each part.

    Raises:
        CertificateError: If the case was not read from a file.
    """
    from screwkit.certificates.written import to_text  # noqa: PLC0415

    certificate = certificate_of(case, answer, progress)
    parts = {(part.question, part.limb): part for part in certificate.parts}

    def of(question: str, own: Listed, limb: str = "") -> dict[str, Any]:
        part = parts.get((question, limb))
        if part is None and not limb:  # no loop: there is nothing to prove
            return {}
        why = "the certificate leaves it out" if part is None else part.reason
        if part is not None and part.proof is not None:
            return {"certified": True, "uncertified": why}
        reason = why if own.complete else own.reason
        return {
            "certified": False,
            "uncertified": why,
            "complete": False,
            "reason": reason,
        }

    limbs = (replace(own, **of("limb", own, own.limb)) for own in answer.limb)
    constraint = replace(answer.constraint, **of("constraint", answer.constraint))
    actuation = answer.actuation
    if actuation is not None and actuation.admissible:
        actuation = replace(actuation, **of("actuation", actuation))
    return replace(
        answer,
        limb=tuple(limbs),
        constraint=constraint,
        actuation=actuation,
        certificate=to_text(certificate),
    )


def certificate_of(
    case: Case, answer: Singularities, progress: Progress = silent
) -> Certificate:
    """The certificate of an answer of `singularities`.

    Args:
        case: As loaded from a file.
        answer: Of this case.
        progress: Told about each part.

    Raises:
        CertificateError: If the case was not read from a file.
    """
    from screwkit.certificates.certification import (  # noqa: PLC0415
        certified,
        certified_graph,
    )
    from screwkit.kinematics.whole_graph import WholeGraph  # noqa: PLC0415
    from screwkit.reports.records import version  # noqa: PLC0415

    source = _source(case)
    if case.network.tied:
        from screwkit.analyses.tied_branch import tied_graph  # noqa: PLC0415
        from screwkit.certificates.tied_certification import (  # noqa: PLC0415
            certified_tied,
        )

        tied = tied_graph(case.network)
        return certified_tied(tied, answer, source, version(), progress)
    graph = case.graph
    if graph is None and case.assembly.has_blocks:
        graph = WholeGraph(case.mechanism)
    if graph is not None:
        return certified_graph(graph, answer, source, version(), progress)
    return certified(case.assembly, answer, source, version(), progress)


def need_free_joints(case: Case) -> None:
    """Refuse a certificate of schemes where loops tie joint variables.

    Raises:
        UndecidedError: If they do.
    """
    if case.network.tied:
        raise UndecidedError(
            f"{case.network.tied}; no certificate of schemes can be written there yet; "
            "without --certificate this question is answered"
        )


def with_certificate(case: Case, answer: Schemes) -> Schemes:
    """An answer of `schemes` with its certificate, as the text of its document.

    Args:
        case: As loaded from a file.
        answer: Of this case.

    Raises:
        CertificateError: If the case was not read from a file, or there is no scheme.
    """
    from screwkit.certificates.scheme_certification import (  # noqa: PLC0415
        certified_schemes,
    )
    from screwkit.certificates.written import to_text  # noqa: PLC0415
    from screwkit.kinematics.whole_graph import WholeGraph  # noqa: PLC0415
    from screwkit.reports.records import version  # noqa: PLC0415

    if not answer.schemes:
        raise CertificateError("there is no scheme that a certificate could speak of")
    blocks = case.graph is None and case.assembly.has_blocks
    graph = WholeGraph(case.mechanism) if blocks else case.graph
    found = certified_schemes(graph or case.assembly, answer, _source(case), version())
    return replace(answer, certificate=to_text(found))


def _source(case: Case) -> Source:
    from screwkit.certificates.records import Source  # noqa: PLC0415

    if case.path is None:
        raise CertificateError("a certificate carries a mechanism file; there is none")
    given = case.given
    return Source(
        case.path.read_text(encoding="utf-8-sig"),
        case.path.suffix.lower() == ".json",
        given.variant,
        {name: str(value) for name, value in given.set_values.items()} or None,
        {name: str(value) for name, value in given.at.items()} or None,
        None if given.actuated is None else tuple(given.actuated),
    )


def verify(
    loaded: Any, certificate: str, case: str | None = None, progress: Progress = silent
) -> Verification:
    """Check a certificate again, from the mechanism alone.

    Args:
        loaded: Not used; `verify` reads its files itself.
        certificate: Its file.
        case: A mechanism file that must be the one the certificate speaks of.
        progress: Told about the stages.

    Raises:
        CertificateError: If the file is no certificate.
        MechanismFileError: If the mechanism that it carries, or ``case``, is wrong.
    """
    from screwkit.analyses.assumed import assumptions_in_words  # noqa: PLC0415
    from screwkit.case import load_text  # noqa: PLC0415
    from screwkit.certificates.checking import check  # noqa: PLC0415
    from screwkit.certificates.missing_parts import missing_from  # noqa: PLC0415
    from screwkit.certificates.signs import declared_signs  # noqa: PLC0415
    from screwkit.certificates.texts import RefusedError  # noqa: PLC0415

    progress("reading the certificate", "")
    document = _read(Path(certificate))
    changes = _changes(document.mechanism)
    try:
        carried = load_text(
            document.mechanism.text, document.mechanism.json, claims=False, **changes
        ).mechanism
    except (MechanismFileError, ScrewkitError) as error:
        reason = f"the mechanism in it cannot be read: {error}"
        return Verification(document.case, "", False, (), reason)
    if case is not None and not _is_about(document.mechanism, carried, case):
        reason = f"it is about another mechanism than {case}"
        return Verification(document.case, carried.title, False, (), reason)
    assumed = assumptions_in_words(carried, *declared_signs(carried))
    progress("checking", f"{len(document.parts)} parts")
    try:
        found = check(document, carried, secrets.randbits(64))
    except (RefusedError, ScrewkitError) as refusal:
        return Verification(document.case, carried.title, False, (), str(refusal))
    parts, schemes = _parts(document, found), document.schemes
    missing = missing_from(document.parts, carried, secrets.randbits(64))
    return Verification(
        document.case,
        carried.title,
        True,
        parts,
        assumptions=assumed,
        missing=() if schemes and not parts else missing,
        schemes=0 if schemes is None else len(schemes.schemes),
        admissible=sum(own.freedom == 0 for own in schemes.schemes) if schemes else 0,
    )


def _is_about(source: Source, carried: Mechanism, case: str) -> bool:
    """Whether a mechanism file says what a certificate's mechanism says.

    The same text is not read twice.

    Raises:
        MechanismFileError: If the file is wrong.
    """
    from screwkit.case import found, load  # noqa: PLC0415

    path, variant = found(case)
    if variant is None and source.json == (path.suffix.lower() == ".json"):
        own = source.text.encode("utf-8")
        with suppress(OSError), path.open("rb") as stream:
            if stream.read(len(own) + 1) == own:
                return True
    return load(case, **_changes(source)).mechanism == carried


def _read(path: Path) -> Certificate:
    from screwkit.certificates.written import (  # noqa: PLC0415
        LARGEST,
        MalformedError,
        from_text,
    )

    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST + 1)
        if len(content) > LARGEST:
            raise CertificateError(f"{path}: larger than {LARGEST} bytes")
        return from_text(content.decode("utf-8"))
    except UnicodeDecodeError:
        raise CertificateError(f"{path}: no certificate: it is no UTF-8 text") from None
    except OSError as error:
        said = error.strerror or "cannot be read"
        raise CertificateError(f"{path}: {said}") from None
    except MalformedError as error:
        raise CertificateError(f"{path}: no certificate: {error}") from None


def _changes(source: Source) -> dict[str, Any]:
    return {
        "variant": source.variant,
        "set_values": dict(source.set_values or {}),
        "at": dict(source.at or {}),
        "actuated": source.actuated,
    }


def _parts(
    document: Certificate, findings: Sequence[Findings]
) -> tuple[VerifiedPart, ...]:
    from screwkit.certificates.findings import name_of  # noqa: PLC0415

    parts = []
    for part, found in zip(document.parts, findings, strict=True):
        equations = [locus.equations for locus in (*part.components, *part.idle)]

        def numbers(
            chosen: Collection[tuple[str, ...]],
            known: list[tuple[str, ...]] = equations,
        ) -> tuple[int, ...]:
            return tuple(n for n, own in enumerate(known, 1) if own in chosen)

        parts.append(
            VerifiedPart(
                name_of(part),
                part.proof is not None,
                len(part.components),
                0 if part.proof is None else _nodes(part.proof),
                part.reason,
                numbers(found.irreducible),
                numbers(found.real),
                numbers(found.sampled_components),
                found.sampled_conditions,
                numbers(found.wider_components),
            )
        )
    return tuple(parts)


def _nodes(node: Node) -> int:
    return 1 + sum(map(_nodes, node.below))
