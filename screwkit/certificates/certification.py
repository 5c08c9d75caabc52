"""Certificates of an answer of `singularities`: each list with its proof."""

from __future__ import annotations

from screwkit.certificates.floors import LimbPart, without_idle_floors
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.part_derivation import PartDerivation
from screwkit.certificates.records import (
    Certificate,
    Part,
    Source,
)
from screwkit.certificates.subjects import (
    are_all,
    of_graph,
    of_limb,
    of_loops,
)
from screwkit.certificates.written import SCHEMA
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.progress import Progress, silent
from screwkit.results.singularities import (
    Singularities,
)


def certified(
    assembly: Assembly,
    answer: Singularities,
    mechanism: Source,
    version: str,
    progress: Progress = silent,
) -> Certificate:
    """The certificate of an answer.

    Args:
        assembly: Of the mechanism.
        answer: Its limb, constraint and actuation singularities.
        mechanism: As it was read, to be carried along.
        version: Of the package.
        progress: Told about each part.
    """
    limbs: list[LimbPart] = []
    parts: list[Part] = []
    for limb, own in zip(assembly.limbs, answer.limb, strict=True):
        progress("certificate", f"limb {limb.name}")
        derivation = PartDerivation(of_limb(assembly, limb))
        limbs.append(derivation.with_floors(derivation.limb(own)))
    if len(assembly.limbs) > 1:
        progress("certificate", "constraint")
        derivation = PartDerivation(of_loops(assembly, (), limbs))
        parts.append(derivation.constraint(answer.constraint))
    actuation = answer.actuation
    if actuation is not None and actuation.admissible and len(assembly.limbs) > 1:
        progress("certificate", "actuation")
        derivation = PartDerivation(of_loops(assembly, actuation.actuated, limbs))
        parts.append(derivation.actuation(actuation))
    whole = (*(limb.told for limb in limbs), *parts)
    return without_idle_floors(
        Certificate(SCHEMA, answer.case, version, mechanism, whole)
    )


def certified_graph(
    graph: WholeGraph,
    answer: Singularities,
    mechanism: Source,
    version: str,
    progress: Progress = silent,
) -> Certificate:
    """The certificate of an answer by the loop equations of the whole joint graph.

    Args:
        graph: Of the mechanism; limbs may have loops inside, or be no limbs at all.
        answer: Its limb, constraint and actuation singularities.
        mechanism: As it was read, to be carried along.
        version: Of the package.
        progress: Told about each part.
    """
    limbs: list[LimbPart] = []
    parts: list[Part] = []
    for limb, own in zip(graph.limbs, answer.limb, strict=True):
        progress("certificate", f"limb {own.limb}")
        matrix = LoopEquations.of(limb, asks_held=True)
        derivation = PartDerivation(of_graph(graph, limb, matrix))
        limbs.append(derivation.with_floors(derivation.limb(own)))
    asked = limbs if are_all(graph) else ()
    if graph.network.loops:
        progress("certificate", "constraint")
        matrix = LoopEquations.of(graph)
        derivation = PartDerivation(of_graph(graph, graph, matrix, (), asked))
        parts.append(derivation.constraint(answer.constraint))
    actuation = answer.actuation
    if actuation is not None and actuation.admissible:
        progress("certificate", "actuation")
        locked = actuation.actuated
        matrix = LoopEquations.of(graph, locked)
        derivation = PartDerivation(of_graph(graph, graph, matrix, locked, asked))
        parts.append(derivation.actuation(actuation))
    whole = (*(limb.told for limb in limbs), *parts)
    return without_idle_floors(
        Certificate(SCHEMA, answer.case, version, mechanism, whole)
    )
