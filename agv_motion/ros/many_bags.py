"""Many bags at once: processes of this machine, or the workers of a Dask cluster.

Whatever ends this process, no worker outlives it: at a signal they are killed at once and what they
had begun is removed; each watches its parent, which may be killed too. A worker that dies takes one
bag with it, and no other.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import deque
from contextlib import suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import wait
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeVar

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files.unfinished import sweep
from agv_motion.ros.stop import SIGNALS, end_no_more

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Sequence
    from multiprocessing.connection import Connection
    from pathlib import Path

    Job = tuple[Path, Path]

FRESH = multiprocessing.get_context('forkserver')
"""a new interpreter that imports once what all workers need, and is forked for each"""
Outcome_co = TypeVar('Outcome_co', covariant=True)
"""A NamedTuple whose ``source`` is the path of the bag."""


class Work(Protocol[Outcome_co]):
    """What is to be done with each bag; it is sent to other processes."""

    def run(
        self, source: Path, target: Path, tell: Callable[[float], None] | None = None
    ) -> Outcome_co:
        """Do it, and return what came of it, failures included.

        Args:
            source: The bag.
            target: Where the result goes.
            tell: Called now and then with the share that is done.

        """

    def modules(self) -> Sequence[str]:
        """Return what `run` imports beside the module of its class."""

    def apart(self) -> bool:
        """Return whether it must not be done in this process."""

    def lost(self, source: Path, reason: str) -> Outcome_co:
        """Return what came of a bag whose worker died."""


class Abandoned(BaseException):
    """Nobody waits for the result any more; like KeyboardInterrupt, no error of the bag."""


def outcomes(
    jobs: Sequence[Job],
    work: Work[Outcome_co],
    workers: int,
    scheduler: str,
    tell: Callable[[float], None] | None = None,
) -> Generator[Outcome_co, None, None]:
    """Yield what came of each bag, as soon as it is known; close it, so that all workers end.

    Args:
        jobs: Each bag, and where its result goes; a cluster must see the same paths.
        work: What to do with each.
        workers: Number of processes.
        scheduler: Address of a Dask scheduler; empty: none.
        tell: Called with the share of the present bag that is done, where there is one at a time.

    Raises:
        ConfigurationError: There is no ``dask.distributed``.
        SourceError: The scheduler does not answer.

    """
    if scheduler:
        yield from _on_cluster(jobs, work, scheduler)
    elif (workers == 1 or len(jobs) == 1) and not work.apart():
        for source, target in jobs:
            yield work.run(source, target, tell)
    else:
        if work.apart():  # texts have the same order in a set then, whenever a worker is started
            os.environ.setdefault('PYTHONHASHSEED', '0')
        yield from _in_processes(jobs, work, min(workers, len(jobs)))


class _Worker(NamedTuple):
    """A process, and the line on which it takes bags and answers."""

    process: Any
    line: Connection


def _in_processes(
    jobs: Sequence[Job], work: Work[Outcome_co], workers: int
) -> Iterator[Outcome_co]:
    waiting = deque(jobs)
    FRESH.set_forkserver_preload([type(work).__module__, *work.modules()])
    busy: dict[Any, tuple[_Worker, Job]] = {}
    free: list[_Worker] = []
    staff: list[_Worker] = []
    try:
        while waiting or busy:
            while waiting and len(busy) < workers:
                worker = free.pop() if free else _start(work, staff)
                job = waiting.popleft()
                busy[worker.line] = worker, job
                with suppress(OSError):  # it is dead: found when it does not answer
                    worker.line.send(job)
            for line in wait(list(busy)):
                worker, job = busy.pop(line)
                try:
                    outcome = worker.line.recv()
                except (EOFError, OSError):
                    worker.process.join()
                    sweep(job[1])
                    outcome = _lost(work, job[0], f'exit status {worker.process.exitcode}')
                else:
                    free.append(worker)
                yield outcome
    except BaseException:
        end_no_more()  # a second signal must not leave half of them
        raise
    finally:
        for worker in staff:
            worker.process.kill()
        for worker in staff:
            worker.process.join()
        for _, (_, target) in busy.values():
            sweep(target)


def _start(work: Work[Any], staff: list[_Worker]) -> _Worker:
    """Start a process and add it to ``staff``, both or none, whatever signal comes meanwhile."""
    line, end = FRESH.Pipe()
    process = FRESH.Process(target=_work, args=(end, work), daemon=True)
    resource_tracker.ensure_running()  # which unblocks signals as it starts: not in between
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        process.start()
        staff.append(_Worker(process, line))
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    end.close()
    return staff[-1]


def _work(line: Connection, work: Work[Any]) -> None:
    """Do the work for what comes on the line, until its other end is gone.

    Born with all signals blocked: Ctrl-C reaches all processes of a terminal, and is the parent's
    to heed.
    """
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        while True:
            source, target = line.recv()
            line.send(work.run(source, target))


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _on_cluster(
    jobs: Sequence[Job], work: Work[Outcome_co], scheduler: str
) -> Iterator[Outcome_co]:
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
            client.submit(_on_worker, source.resolve(), target.absolute(), work, pure=False): (
                source,
                target,
            )
            for source, target in jobs
        }
        try:
            for future in distributed.as_completed(waiting):
                death = future.exception()
                if death is None:
                    outcome: Any = future.result()  # a NamedTuple, with the path as it is there
                    yield outcome._replace(source=str(waiting[future][0]))
                else:
                    source, target = waiting[future]
                    sweep(target)
                    yield _lost(work, source, f'{type(death).__name__} {death}')
        finally:
            client.cancel([future for future in waiting if not future.done()], force=True)


def _on_worker(source: Path, target: Path, work: Work[Outcome_co]) -> Outcome_co:
    """Do the work for a bag on a worker of the cluster, as long as somebody waits for it."""
    from distributed import get_worker

    here = get_worker()
    key = here.get_current_task()

    def look(_: float) -> None:
        task = here.state.tasks.get(key)
        if task is None or task.state == 'cancelled':
            raise Abandoned

    return work.run(source, target, look)


def _lost(work: Work[Outcome_co], source: Path, reason: str) -> Outcome_co:
    """Return the outcome of a bag whose worker died."""
    return work.lost(source, f'its worker ended: {reason}; run again to complete')
