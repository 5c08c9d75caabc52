"""Sweeps: order, chunks and executors, files, samples and optima."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from math import pi
from pathlib import Path
from typing import Any

import distributed
import numpy as np
import pytest

import screwkit as sk
from screwkit.errors import (
    ExpressionError,
    ScrewkitError,
    UndecidedError,
    UnknownNameError,
    UnwritableError,
)
from screwkit.metrics.index_function import index_function
from screwkit.sweeps.grid import axis_of, grid_of
from screwkit.sweeps.objective import objective_of
from screwkit.sweeps.run import swept

CASE = "stewart_alpha_beta"
REFERENCE = Path(__file__).parents[1] / "reference" / "cooperating.json"
KNOWN = ("alpha", "beta")
RANGES = ["alpha=0.2:1:5", "beta=-2:-1:4"]


def published_optima() -> dict[str, Any]:
    """Recomputed independently: optima over both angles."""
    cases = json.loads(REFERENCE.read_text(encoding="utf-8"))["cases"]
    found: dict[str, Any] = cases["bicchi_prattichizzo_stewart"]
    return found


def test_the_last_range_runs_fastest() -> None:
    grid = grid_of([axis_of("alpha=0:1:2", KNOWN), axis_of("beta=0:pi/2:3", KNOWN)])
    points = grid.points(0, grid.size)
    assert (grid.shape, grid.size) == ((2, 3), 6)
    assert points["alpha"].tolist() == [0, 0, 0, 1, 1, 1]
    assert np.allclose(points["beta"], [0, pi / 4, pi / 2] * 2)
    some = grid.points(2, 5)
    assert some["alpha"].tolist() == [0, 1, 1]


@pytest.mark.parametrize(
    ("text", "error", "said"),
    [
        ("alhpa=0:1:3", UnknownNameError, "did you mean 'alpha'"),
        ("alpha=0:1", ExpressionError, "NAME=START:STOP:COUNT"),
        ("alpha=0:1:3.5", ExpressionError, "no number of steps"),
        ("alpha=0:1:0", ExpressionError, "no number of steps"),
        ("alpha=0:x:3", ExpressionError, "unknown name 'x'"),
    ],
)
def test_what_is_no_range_is_refused(
    text: str, error: type[ScrewkitError], said: str
) -> None:
    with pytest.raises(error, match=said):
        axis_of(text, KNOWN)


def test_a_range_twice_and_a_grid_without_end_are_refused() -> None:
    with pytest.raises(ExpressionError, match="varied twice"):
        grid_of([axis_of("alpha=0:1:3", KNOWN)] * 2)
    with pytest.raises(ExpressionError, match="are more than"):
        grid_of([axis_of(f"{name}=0:1:100000", KNOWN) for name in KNOWN])


def test_values_are_those_of_the_index() -> None:
    found = sk.sweep(sk.load(CASE), RANGES, "kinematic.min")
    assert found.values.shape == (5, 4)
    function = index_function(sk.load(CASE).mechanism)
    single = function({"alpha": found.axes["alpha"][3], "beta": found.axes["beta"][1]})
    assert np.isclose(found.values[3, 1], single[-1], rtol=1e-10)


def test_chunks_and_executors_change_nothing() -> None:
    objective = objective_of(sk.load(CASE).mechanism, "kinematic.misfit", KNOWN)
    grid = grid_of([axis_of(text, KNOWN) for text in RANGES])
    whole = swept(objective, grid)
    assert (swept(objective, grid, chunk=3) == whole).all()
    with ThreadPoolExecutor(2) as threads:
        assert (swept(objective, grid, threads, chunk=7) == whole).all()
    with ProcessPoolExecutor(2) as processes:
        assert (swept(objective, grid, processes, chunk=6) == whole).all()


def test_a_dask_cluster_is_an_executor() -> None:
    objective = objective_of(sk.load(CASE).mechanism, "kinematic.min", KNOWN)
    grid = grid_of([axis_of(text, KNOWN) for text in RANGES])
    with (
        distributed.LocalCluster(
            n_workers=1, processes=False, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = swept(objective, grid, client.get_executor(), chunk=6)
    assert (found == swept(objective, grid)).all()


def test_an_interrupted_sweep_goes_on_where_it_stopped(tmp_path: Path) -> None:
    objective = objective_of(sk.load(CASE).mechanism, "kinematic.min", KNOWN)
    grid = grid_of([axis_of(text, KNOWN) for text in RANGES])
    whole, kept = swept(objective, grid), tmp_path / "chunks"
    swept(objective, grid, kept_in=kept, chunk=5)
    lines = kept.read_text(encoding="utf-8").splitlines(keepends=True)
    kept.write_text("".join(lines[:2]) + lines[2][:7], encoding="utf-8")
    asked: list[int] = []
    again = swept(
        objective, grid, kept_in=kept, chunk=5, done=lambda n, of: asked.append(n)
    )
    assert (again == whole).all()
    assert asked == [10, 15, 20]
    asked.clear()
    swept(objective, grid, kept_in=kept, chunk=5, done=lambda n, of: asked.append(n))
    assert asked == []  # what was added after the half line is read as well
    other = grid_of([axis_of("alpha=0.3:1:20", KNOWN)])
    assert (swept(objective, other, kept_in=kept) == swept(objective, other)).all()


def test_another_process_knows_the_sweep_again() -> None:
    """What is kept on disk is found after a restart, whatever the hashes of texts."""
    program = (
        "import screwkit as sk\n"
        "from screwkit.sweeps.grid import axis_of, grid_of\n"
        "from screwkit.sweeps.objective import objective_of\n"
        "from screwkit.sweeps.run import fingerprint\n"
        f"o = objective_of(sk.load({CASE!r}).mechanism, 'locus', {KNOWN!r})\n"
        f"print(fingerprint(o, grid_of([axis_of({RANGES[0]!r}, {KNOWN!r})])))\n"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": seed},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(found) == 1


def test_files_hold_every_value(tmp_path: Path) -> None:
    table, arrays = tmp_path / "map.csv", tmp_path / "map.npz"
    found = sk.sweep(sk.load(CASE), RANGES, output=table)
    sk.sweep(sk.load(CASE), RANGES, output=arrays)
    with table.open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head == ["alpha", "beta", "kinematic.min"]
    assert [float(row[2]) for row in rows] == found.values.ravel().tolist()
    with np.load(arrays) as loaded:
        assert (loaded["values"] == found.values).all()
        assert (loaded["axis_beta"] == found.axes["beta"]).all()
        assert str(loaded["index"]) == "kinematic.min"


def test_a_file_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(ScrewkitError, match=r"written as \.csv or \.npz"):
        sk.sweep(sk.load(CASE), RANGES, output=tmp_path / "map.xls")
    with pytest.raises(UnwritableError):
        sk.sweep(sk.load(CASE), RANGES, output=tmp_path / "nowhere" / "map.csv")
    assert list(tmp_path.iterdir()) == []


def test_samples_fill_the_box() -> None:
    found = sk.sweep(sk.load(CASE), RANGES, samples=64)
    assert found.values.shape == (64,)
    alpha = found.axes["alpha"]
    assert 0.2 <= alpha.min() < alpha.max() <= 1
    # Evenly spread: each quarter of the range holds near to a quarter of the points.
    counts, _ = np.histogram(alpha, bins=4, range=(0.2, 1))
    assert counts.min() >= 12


@pytest.mark.parametrize(
    ("weight", "key", "ranges"),
    [
        ("1", "optimum_Wu_identity", ["alpha=-pi:pi:31", "beta=-pi:pi:31"]),
        ("5", "optimum_Wu_inverse_Wtask", ["alpha=-1:0:6", "beta=0:1:6"]),
    ],
)
def test_the_optima_of_the_stewart_platform(
    weight: str, key: str, ranges: list[str]
) -> None:
    """[BicchiPrattichizzo] §V-B: the least misfit over (α, β), corrected (E18).

    (α, β) → (−α, −β) and (β, α) give the same platform again.
    """
    wanted = published_optima()[key]
    case = sk.load(CASE, set_values={"w": weight})
    best = sk.sweep(case, ranges, "kinematic.misfit", best="least").answer.best
    assert best is not None
    assert np.isclose(1 / best.value, wanted["one_over_C"], rtol=1e-9)
    alpha, beta = np.degrees(best.values)
    a, b = wanted["alpha_deg"], wanted["beta_deg"]
    alike = [(a, b), (b, a), (-a, -b), (-b, -a)]
    assert min(max(abs(alpha - x), abs(beta - y)) for x, y in alike) < 1e-5
    function = index_function(case.mechanism)
    found = function(dict(zip(KNOWN, map(np.array, best.values), strict=True)))
    assert np.allclose(found, wanted["eigenvalues"], rtol=1e-6)


@pytest.mark.parametrize(
    ("index", "error"),
    [("kinematik.min", UnknownNameError), ("kinematic.least", UnknownNameError)],
)
def test_an_unknown_index_is_refused(index: str, error: type[ScrewkitError]) -> None:
    with pytest.raises(error, match="no index"):
        sk.sweep(sk.load(CASE), RANGES, index)


def test_a_symbol_without_a_number_is_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(
        "screwkit: 1\nname: arm\nspace: planar\ngeometry: posture\nbase: base\n"
        "platform: tool\nlinks: [base, a, tool]\nparameters: {l: {}, m: 1}\njoints:\n"
        "  - {name: A, type: revolute, parent: base, child: a, point: [0, 0]}\n"
        "  - {name: B, type: revolute, parent: a, child: tool, point: [l, m]}\n"
        "actuated: [A, B]\n",
        encoding="utf-8",
    )
    with pytest.raises(UndecidedError, match="no value for l: --set l="):
        sk.sweep(sk.load(path), ["m=1:2:3"])
