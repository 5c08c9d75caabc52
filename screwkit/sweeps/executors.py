"""Executors for sweeps: processes of this machine, or an existing Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from screwkit.errors import MissingToolError, ScrewkitError


@contextmanager
def executor_of(workers: int = 0, scheduler: str = "") -> Iterator[Executor | None]:
    """An executor, closed at the end; None evaluates in this process.

    Args:
        workers: Processes to start on this machine; 0 for none.
        scheduler: Address of a running Dask scheduler; empty for none.

    Raises:
        MissingToolError: If Dask is asked for and not installed.
        ScrewkitError: If no scheduler answers at the address.
    """
    if scheduler:
        try:
            from distributed import Client  # noqa: PLC0415 -- an optional tool
        except ImportError:
            raise MissingToolError(
                "a Dask cluster needs the package distributed: "
                "pip install 'screwkit[dask]'"
            ) from None
        try:
            client = Client(scheduler)
        except (OSError, ValueError) as error:
            raise ScrewkitError(
                f"no Dask scheduler answers at {scheduler!r} (--scheduler): {error}"
            ) from None
        with client:
            yield client.get_executor()
    elif workers:
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            yield pool
    else:
        yield None
