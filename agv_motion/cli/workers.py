"""Many bags at once: processes of this machine, or the workers of a Dask cluster."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import TYPE_CHECKING

from agv_motion.cli.reprocess_bag import Outcome, Plan, reprocess
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Future
    from pathlib import Path

    Job = tuple[Path, Path]


def outcomes(
    jobs: Sequence[Job],
    plan: Plan,
    workers: int,
    scheduler: str,
    tell: Callable[[float], None] | None = None,
) -> Iterator[Outcome]:
    """Yield what came of each bag, as soon as it is known.

    Args:
        jobs: Each bag, and where its result goes; a cluster must see the same paths.
        plan: What to run.
        workers: Number of processes.
        scheduler: Address of a Dask scheduler; empty: none.
        tell: Called with the share of the present bag that is done, where there is one at a time.

    Raises:
        ConfigurationError: There is no ``dask.distributed``.
        SourceError: The scheduler does not answer.

    """
    if scheduler:
        yield from _on_cluster(jobs, plan, scheduler)
    elif workers == 1 or len(jobs) == 1:
        for source, target in jobs:
            yield reprocess(source, target, plan, tell)
    else:
        yield from _in_processes(jobs, plan, workers)


def _in_processes(jobs: Sequence[Job], plan: Plan, workers: int) -> Iterator[Outcome]:
    fresh = multiprocessing.get_context('spawn')
    with ProcessPoolExecutor(min(workers, len(jobs)), mp_context=fresh) as pool:
        waiting: dict[Future[Outcome], Job] = {
            pool.submit(reprocess, *job, plan): job for job in jobs
        }
        for future in as_completed(waiting):
            death = future.exception()
            yield future.result() if death is None else _lost(waiting[future], death)


def _on_cluster(jobs: Sequence[Job], plan: Plan, scheduler: str) -> Iterator[Outcome]:
    try:
        import distributed
    except ImportError as error:
        msg = f"a cluster needs dask.distributed: pip install 'agv_motion[cluster]' ({error})"
        raise ConfigurationError(msg) from error
    try:
        client = distributed.Client(scheduler, timeout='10s')
    except (OSError, ValueError) as error:
        msg = f'the Dask scheduler {scheduler} does not answer: {error}; start dask scheduler there'
        raise SourceError(msg) from error
    with client:
        waiting = {
            client.submit(reprocess, source.resolve(), target.resolve(), plan, pure=False): (
                source,
                target,
            )
            for source, target in jobs
        }
        for future in distributed.as_completed(waiting):
            death = future.exception()
            outcome = future.result() if death is None else _lost(waiting[future], death)
            yield outcome._replace(source=str(waiting[future][0]))


def _lost(job: Job, error: BaseException) -> Outcome:
    """Return the outcome of a bag whose worker died."""
    failure = f'its worker ended: {type(error).__name__} {error}'
    return Outcome(str(job[0]), 0, 0, 0.0, 0.0, (), {}, failure)
