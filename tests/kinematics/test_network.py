"""Loop ranks, mobility and twists of any joint graph: second opinions and laws."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from kinematics.float_loops import FloatLoops, counted
from kinematics.random_mechanisms import (
    Similarity,
    left_by_constraints,
    mechanism_of,
    mechanisms,
    random_joint,
    random_mechanism,
    rescaled,
    turned_round,
    written,
)
from kinematics.random_mechanisms import rank as rational_rank
from loci.numeric import Array

from screwkit.algebra.modular import echelon
from screwkit.analyses.counts import counts, limb_systems
from screwkit.analyses.mobility import actuation, connectivity
from screwkit.analyses.platform import platform
from screwkit.case import bundled_cases, load
from screwkit.kinematics import network as network_module
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.kinematics.subspaces import dimension, reciprocal
from screwkit.mechanism.model import Joint, JointType, Mechanism, Space

laws = settings(max_examples=60, derandomize=True)
seeds = st.integers(0, 2**20)
CLEAR = 1e4


@cache
def every_case() -> tuple[tuple[str, str | None], ...]:
    """Every bundled case with every variant of it."""
    return tuple(
        (name, variant)
        for name in bundled_cases()
        for variant in (None, *load(name).variants)
    )


@pytest.mark.parametrize(
    ("name", "variant"),
    every_case(),
    ids=[f"{n}-{v or 'file'}" for n, v in every_case()],
)
def test_bundled_cases_have_the_ranks_of_floats(name: str, variant: str | None) -> None:
    """At the file's values: loop rank, the platform's freedoms, locked mobility."""
    mechanism = load(name, variant=variant).mechanism
    network = Network(mechanism)
    at = (network.at_values or network).motion
    floats = FloatLoops(mechanism)
    free = len(network.labels)

    loops = counted(floats.loop_matrix())
    assert loops.gap >= CLEAR
    assert at.rank == loops.rank
    assert at.mobility == free - loops.rank

    base, end = mechanism.base, mechanism.platform
    about = platform(at)
    if network.connected(base, end):
        twists = floats.body_twists(end, base)
        all_of_it, turning = counted(twists), counted(above_noise(twists[:3]))
        assert min(all_of_it.gap, turning.gap) >= CLEAR
        assert about.twist_dimension == len(at.platform_twists) == all_of_it.rank
        assert about.translations == all_of_it.rank - turning.rank
        # Couples reciprocal to all twists are orthogonal to all angular velocities.
        planar = mechanism.space == "planar"
        assert about.couples == (1 if planar else 3) - turning.rank
        assert about.wrench_dimension == (3 if planar else 6) - all_of_it.rank
    if locked := actuation(at):
        held = counted(floats.loop_matrix(locked.actuated))
        assert held.gap >= CLEAR
        left = free - len(locked.actuated) - held.rank
        assert locked.remaining_mobility == left
        still = counted(above_noise(floats.body_twists(end, base, locked.actuated)))
        assert still.gap >= CLEAR
        assert locked.remaining_platform_freedom == still.rank


def above_noise(matrix: Array) -> Array:
    """Zero where all of a block is rounding; its rank is then 0."""
    return matrix if matrix.size and abs(matrix).max() > 1e-9 else 0 * matrix


def roots(network: Network) -> list[str]:
    base = network.mechanism.base
    return [base if base in group else group[0] for group in network.components]


def span(motion_: Motion, one: str, other: str) -> list[list[int]]:
    return echelon(motion_.twists_of(one, other), motion_.posture.prime)


@laws
@given(mechanisms())
def test_freedoms_are_those_that_constraint_wrenches_leave(
    mechanism: Mechanism,
) -> None:
    """Over the rationals and without loops: every joint, contact and graph."""
    network = Network(mechanism)
    found = left_by_constraints(mechanism, roots(network))
    for at in network.motions:
        assert at.mobility == found.mobility
        assert at.rank + at.mobility == len(network.labels)
        for link in mechanism.links:
            if network.connected(link, mechanism.base):
                twists = found.between(link, mechanism.base)
                assert len(at.twists_of(link)) == rational_rank(twists)
    base, end = mechanism.base, mechanism.platform
    if network.connected(base, end):
        twists = found.between(end, base)
        turning = [t[:3] if len(t) == 6 else t[:1] for t in twists]
        about = platform(network.motion)
        assert about.translations == rational_rank(twists) - rational_rank(turning)


@laws
@given(mechanisms(bodies=7, extra=6))
def test_rates_close_all_loops_and_joints_do_what_they_allow(
    mechanism: Mechanism,
) -> None:
    """Σ ± twist·rate = 0 around loops, and body twists differ by the joint's own."""
    network = Network(mechanism)
    at = network.motion
    prime, twists = at.posture.prime, at.posture.twists
    for rates in at.rates:
        assert rates
        assert all(0 < x < prime for x in rates.values())
        bodies = at.body_twists(rates)
        for joint in mechanism.joints:
            own = [
                sum(
                    rates.get(label, 0) * twists[label][k]
                    for label in network.labels_of[joint.name]
                )
                for k in range(6)
            ]
            pairs = zip(bodies[joint.child], bodies[joint.parent], own, strict=True)
            assert all((a - b - c) % prime == 0 for a, b, c in pairs)
        moved = {link for link, twist in bodies.items() if any(twist)}
        assert set(at.moving(rates)) == moved
        assert not moved & set(roots(network))
    rows = [[rates.get(label, 0) for label in network.labels] for rates in at.rates]
    assert dimension(rows, prime) == at.mobility


@laws
@given(mechanisms(), seeds)
def test_nothing_depends_on_how_the_file_is_written(
    mechanism: Mechanism, seed: int
) -> None:
    """Another place and scale, names, orders, senses and lengths of axes."""
    source = random.Random(seed)
    move = Similarity.drawn(source, mechanism.space)
    called = {link: f"x{n}" for n, link in enumerate(mechanism.links)}
    joints = []
    for n, joint in enumerate(mechanism.joints):
        new = rescaled(move.of_joint(joint), source)
        if source.random() < 0.5:
            new = turned_round(new)
        ends = called[new.parent], called[new.child]
        joints.append(replace(new, name=f"y{n}", parent=ends[0], child=ends[1]))
    source.shuffle(joints)
    links = list(called.values())
    source.shuffle(links)
    other = mechanism_of(
        joints,
        links,
        mechanism.space,
        called[mechanism.base],
        called[mechanism.platform],
    )
    one, two = Network(mechanism), Network(other)
    assert (one.motion.rank, one.motion.mobility) == (
        two.motion.rank,
        two.motion.mobility,
    )
    for link in mechanism.links:
        for to in mechanism.links:
            first = one.motion.twists_of(link, to)
            second = two.motion.twists_of(called[link], called[to])
            assert len(first) == len(second)
    before, after = platform(one.motion), platform(two.motion)
    assert before.motion_type == after.motion_type
    assert before.couples == after.couples


@laws
@given(mechanisms())
def test_relative_twists_add_and_change_their_sign(mechanism: Mechanism) -> None:
    network = Network(mechanism)
    at = network.motion
    prime = at.posture.prime
    links = mechanism.links
    for one in links:
        assert at.twists_of(one, one) == []
        for other in links:
            there = span(at, one, other)
            assert there == span(at, other, one)
            if not network.connected(one, other):
                continue
            negative = [[-x % prime for x in row] for row in there]
            assert echelon(negative, prime) == there
            middle = [m for m in links if network.connected(m, one)]
            for between in middle:
                whole = [*at.twists_of(one, between), *at.twists_of(between, other)]
                assert dimension([*whole, *there], prime) == dimension(whole, prime)


@laws
@given(mechanisms())
def test_a_joint_allows_no_more_than_its_own_twists(mechanism: Mechanism) -> None:
    at = Network(mechanism).motion
    prime = at.posture.prime
    for joint in mechanism.joints:
        own = [
            list(at.posture.twists[label]) for label in at.network.labels_of[joint.name]
        ]
        relative = at.twists_of(joint.child, joint.parent)
        assert dimension([*own, *relative], prime) == dimension(own, prime)


@laws
@given(mechanisms())
def test_the_table_of_connectivity(mechanism: Mechanism) -> None:
    """Symmetric, zero on the diagonal, and the way over a third body is no shorter."""
    network = Network(mechanism)
    found = connectivity(network.motion)
    assert found is not None
    table, size = found.table, len(network.rows)
    for i, row in enumerate(table):
        assert row[i] == 0
        for k, entry in enumerate(row):
            assert entry == table[k][i]
            if not network.connected(found.bodies[i], found.bodies[k]):
                assert entry == size
            else:
                assert all(entry <= row[m] + table[m][k] for m in range(len(row)))


@laws
@given(mechanisms(), seeds)
def test_a_rigid_link_more_changes_nothing(mechanism: Mechanism, seed: int) -> None:
    """A joint hangs on a new link that is fixed to its old one."""
    assume(mechanism.joints)
    source = random.Random(seed)
    moved = source.choice(mechanism.joints)
    kind = source.choice([JointType.FIXED, JointType.COMPLETE])
    held = Joint("held", kind, moved.parent, "bracket")
    joints = [
        replace(j, parent="bracket") if j is moved else j for j in mechanism.joints
    ]
    other = replace(
        mechanism, joints=(*joints, held), links=(*mechanism.links, "bracket")
    )
    one, two = Network(mechanism).motion, Network(other).motion
    assert (one.rank, one.mobility) == (two.rank, two.mobility)
    assert two.twists_of("bracket", moved.parent) == []
    for link in mechanism.links:
        assert len(one.twists_of(link)) == len(two.twists_of(link))


@laws
@given(mechanisms(), seeds)
def test_locking_takes_rates_away(mechanism: Mechanism, seed: int) -> None:
    """What stays are the rates that are 0 at the locked freedoms."""
    network = Network(mechanism)
    at = network.motion
    source = random.Random(seed)
    locked = [label for label in network.labels if source.random() < 0.3]
    held = motion(network, at.posture, locked)
    rows = [[rates.get(label, 0) for label in locked] for rates in at.rates]
    assert held.mobility == at.mobility - dimension(rows, at.posture.prime)
    assert held.rank + held.mobility == len(network.labels) - len(locked)
    assert not any(set(locked) & set(rates) for rates in held.rates)


@laws
@given(mechanisms(bodies=6, extra=5))
def test_limbs_meet_in_the_platform(mechanism: Mechanism) -> None:
    """The platform can do what every limb allows it, limbs alone by constraints."""
    network = Network(mechanism)
    at = network.motion
    prime = at.posture.prime
    systems = limb_systems(at)
    base, end = mechanism.base, mechanism.platform
    assume(systems and base != end)
    wrenches = [w for system in systems for w in reciprocal(system.twists, prime)]
    common = reciprocal(wrenches, prime)
    assert echelon(common, prime) == span(at, end, base)
    for system in systems:
        alone = network.part(system.limb.joints, (base, end)).mechanism
        found = left_by_constraints(alone, [base])
        assert len(system.twists) == rational_rank(found.between(end, base))
        assert system.freedoms == system.inner_rank + len(system.twists) + system.idle
        assert found.mobility == len(system.twists) + system.idle


@laws
@given(mechanisms(bodies=6, extra=5))
def test_counts_that_see_the_geometry_tell_the_mobility(mechanism: Mechanism) -> None:
    """Moroskine and screws; Gogu's and Grübler's never tell more than there is."""
    at = Network(mechanism).motion
    found, workings = counts(at, at.rank)
    assert found.moroskine == at.mobility
    assert found.grubler <= at.mobility
    if found.screw is not None:
        assert found.screw == at.mobility
    if found.gogu is not None:
        assert found.gogu <= at.mobility
    values = {w.name: w.value for w in workings}
    assert values["Moroskine"] == found.moroskine


@laws
@given(mechanisms(bodies=7, extra=6))
def test_dense_and_sparse_elimination_agree(mechanism: Mechanism) -> None:
    network = Network(mechanism)
    dense = network.motion
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(network_module, "DENSE", -1)
        sparse = motion(network, dense.posture)
    assert (sparse.rank, sparse.mobility) == (dense.rank, dense.mobility)
    for link in mechanism.links:
        assert span(sparse, link, mechanism.base) == span(dense, link, mechanism.base)


def hinges(
    points: Sequence[tuple[int, int, int]], axis: tuple[int, int, int]
) -> Network:
    """Parallel revolute joints between the same two bodies."""
    joints = [
        Joint(
            f"h{n}",
            JointType.REVOLUTE,
            "frame",
            "door",
            (f"q{n}",),
            axes=(written(axis),),
            point=written(point),
        )
        for n, point in enumerate(points)
    ]
    return Network(mechanism_of(joints, ["frame", "door"]))


def test_a_door_with_three_hinges_in_line() -> None:
    """One axis: each further hinge closes a loop of rank 1 and is 5 times redundant."""
    at = hinges([(0, 0, 0), (0, 0, 2), (0, 0, 5)], (0, 0, 1)).motion
    assert (at.rank, at.mobility, len(at.network.loops)) == (2, 1, 2)
    assert len(at.platform_twists) == 1


def test_a_door_with_hinges_out_of_line_is_shut() -> None:
    at = hinges([(0, 0, 0), (1, 0, 2)], (0, 0, 1)).motion
    assert (at.rank, at.mobility, at.platform_twists) == (2, 0, [])


def test_a_lone_body_and_loose_bodies() -> None:
    lone = Network(mechanism_of([], ["body"]))
    assert (lone.motion.rank, lone.motion.mobility) == (0, 0)
    assert (lone.loops, lone.motion.platform_twists) == ((), [])
    loose = Network(mechanism_of([], ["body", "other"]))
    assert loose.motion.mobility == 0
    assert len(loose.motion.platform_twists) == 6
    flat = Network(mechanism_of([], ["body", "other"], "planar"))
    assert len(flat.motion.platform_twists) == 3
    assert not loose.connected("body", "other")


@pytest.mark.parametrize("seed", range(10))
def test_trees_move_with_all_their_freedoms(seed: int) -> None:
    mechanism = random_mechanism(seed, 6, 0)
    network = Network(mechanism)
    assert (network.loops, network.motion.rank) == ((), 0)
    assert network.motion.mobility == len(network.labels)


@pytest.mark.parametrize("space", ["spatial", "planar"])
@pytest.mark.parametrize("seed", range(4))
def test_apart_from_each_other_mobilities_add(seed: int, space: Space) -> None:
    """Two mechanisms in one file, between which no joint is."""
    pair = [random_mechanism(seed + k, 5, 3, space) for k in (0, 100)]
    joints: list[Joint] = []
    links: list[str] = []
    for k, each in enumerate(pair):
        links += [f"{k}{link}" for link in each.links]
        joints += [
            replace(
                j, name=f"{k}{j.name}", parent=f"{k}{j.parent}", child=f"{k}{j.child}"
            )
            for j in each.joints
        ]
    both = Network(mechanism_of(joints, links, pair[0].space)).motion
    alone = [Network(each).motion for each in pair]
    assert both.mobility == sum(at.mobility for at in alone)
    assert both.rank == sum(at.rank for at in alone)


def grid(rows: int, columns: int) -> Mechanism:
    """Bodies on a grid, revolute joints with axes z between neighbours."""
    source = random.Random(1)
    joints: list[Joint] = []
    for i in range(rows):
        for k in range(columns):
            for a, b in ((i + 1, k), (i, k + 1)):
                if a < rows and b < columns:
                    joint = random_joint(
                        source, JointType.REVOLUTE, (f"b{i}_{k}", f"b{a}_{b}")
                    )
                    shift = source.randint(-50, 50), source.randint(-50, 50), 0
                    joints.append(
                        replace(
                            joint,
                            name=f"j{len(joints)}",
                            axes=(written((0, 0, 1)),),
                            point=written(shift),
                        )
                    )
    links = [f"b{i}_{k}" for i in range(rows) for k in range(columns)]
    return mechanism_of(joints, links)


def test_flat_frames_have_the_rank_of_the_plane() -> None:
    """A grid in general position: 3 equations a loop count, until nothing moves."""
    network = Network(grid(2, 9))
    joints, loops = len(network.labels), len(network.loops)
    assert loops == 8
    assert network.motion.rank == 3 * loops < joints
    assert Network(grid(4, 4)).motion.rank == 24


def test_symbols_are_generic_and_values_may_be_special() -> None:
    """Where the legs are parallel the platform gains freedoms that others lack."""
    mechanism = load("3upu_tsai", variant="parallel_legs").mechanism
    network = Network(mechanism)
    assert network.at_values is not None
    assert network.motion.rank > network.at_values.motion.rank


def test_exact_numbers_leave_nothing_to_tolerance() -> None:
    """A hinge 10⁻³⁰ out of line shuts the door; floats could not tell."""
    near = Fraction(1, 10**30)
    network = hinges([(0, 0, 0), (0, 0, 2)], (0, 0, 1))
    last = replace(network.mechanism.joints[1], point=written((near, 0, 2)))
    shut = replace(network.mechanism, joints=(network.mechanism.joints[0], last))
    assert network.motion.mobility == 1
    assert Network(shut).motion.mobility == 0
