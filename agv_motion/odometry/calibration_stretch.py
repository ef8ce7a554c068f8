r"""One stretch of a drive, made ready for least squares: whitened, and rid of its unknown start.

The wheels predict every reference pose from the start of the stretch, the unknowns, and the slip
of the base in each step against wheels that turn as their encoders say. What is left differs by
the noise of the references, independent of each other, and by slip, which adds up on the way: an
error made once about the origin (see `dead_reckoning`) stays, so the covariance of the errors at
two references is that of all the steps before the first,

.. math:: \Sigma_{jk} = H_j W_{\min(j, k)} H_k^T + \delta_{jk} R,\qquad
    H_k = \begin{pmatrix} 1 & 0 & -y_k \\ 0 & 1 & x_k \\ 0 & 0 & 1 \end{pmatrix}

Its Cholesky factor whitens the errors; a projection then removes all that another start could
explain, and stretches can be put one below the other. The likeliest slip follows the unknowns: a
path that winds where the robot's did makes no wheel too large.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.odometry.columns import adjoint_columns, matrix, noise_columns, pose_columns
from agv_motion.planar import Pose, Twist, compose, exponential

if TYPE_CHECKING:
    from agv_motion.odometry.calibration_models import CalibrationModel
    from agv_motion.odometry.calibration_recording import CalibrationDrive

Array = NDArray[np.float64]

STEP = 1e-3
"""[-] Of the numeric derivative, as a share of the doubt about an unknown."""
OUTLIER = 5.0
"""[-] Standard deviations beyond which a reference is left out."""
FEWEST = 9
"""Numbers of references that are left in any case."""
MEDIAN = 0.6745
"""[-] of the absolute value of a normal variable, in standard deviations"""


class _Linear(NamedTuple):
    """The errors of a stretch about its present path; one row a number of a reference."""

    slope: Array
    """(r, p) by the unknowns"""
    start: Array
    """(r, 3) by a small motion of the start, and of the world with it"""
    error: Array
    """(r,) as without slip"""
    root: Array
    """(r, r) Cholesky factor of their covariance"""
    levers: Array
    """(k, 3, 3) what a small motion of the world does to the pose at each reference"""
    adjoint: Array
    """(m, 3, 3) what the slip of each step does to the world"""
    chosen: Array
    """(3 k,) which numbers of the references are known"""


class Stretch:
    """A stretch and its start, which follows the unknowns."""

    def __init__(
        self, model: CalibrationModel, recording: CalibrationDrive, wheel_noise: float
    ) -> None:
        """Lay the start where the nominal wheels fit the references best.

        Args:
            model: The base.
            recording: One of :meth:`CalibrationDrive.stretches`.
            wheel_noise: Standard deviation of the travel of a wheel after 1 m [m].

        """
        self._model = model
        self._steps = recording.reference_step
        self._turned = recording.turned
        none = np.zeros_like(recording.turned)
        self._steering = none if recording.steering is None else recording.steering
        rolled = np.abs(model.radii[:, None] * recording.turned).mean(axis=0)
        self._variance = wheel_noise**2 * rolled
        self._noise = np.array([recording.position_noise] * 2 + [recording.heading_noise])
        centre = recording.reference[:2].mean(axis=1)
        self._reference = recording.reference - np.array([*centre, 0.0])[:, None]
        self._known = np.isfinite(self._reference)
        self._unit = matrix(model.unit_covariance)
        self._start = self._first_start()
        self._slip = np.zeros((3, recording.turned.shape[1]))
        self._last: _Linear | None = None

    @property
    def references(self) -> int:
        """How many references are in use."""
        return int(self._known[0].sum())

    def rows(self, values: Array) -> tuple[Array, Array]:
        """Return derivative (r, p) and error (r,), whitened, whatever the start explains removed.

        Args:
            values: (p,) the unknowns.

        """
        linear = self._linear(values)
        size = linear.slope.shape[1]
        white = np.linalg.solve(
            linear.root, np.column_stack([linear.slope, linear.start, linear.error])
        )
        basis, _ = np.linalg.qr(white[:, size:-1])
        rows = white - basis @ (basis.T @ white)
        self._last = linear
        return rows[:, :size], rows[:, -1]

    def follow(self, change: Array) -> None:
        """Let start and slip explain what a change (p,) of the unknowns leaves of the errors."""
        assert self._last is not None
        slope, start, error, root, levers, adjoint, chosen = self._last
        left = np.linalg.solve(root, np.column_stack([start, error - slope @ change]))
        shift, *_ = np.linalg.lstsq(left[:, :3], left[:, 3], rcond=None)
        self._start = compose(exponential(Twist(*map(float, shift))), self._start)
        pull = np.zeros(len(chosen))
        pull[chosen] = np.linalg.solve(root.T, left[:, 3] - left[:, :3] @ shift)
        on_world = np.einsum('kij,ki->kj', levers, pull.reshape(-1, 3))
        after = np.concatenate([np.cumsum(on_world[::-1], axis=0)[::-1], np.zeros((1, 3))])
        first_after = np.searchsorted(self._steps, np.arange(len(adjoint)), side='right')
        on_base = np.einsum('mij,mi->jm', adjoint, after[first_after])
        self._slip = self._variance * (self._unit @ on_base)

    def slip_unlikeliness(self, shares: Array) -> Array:
        """Return how unlikely the errors were, had slip a share of the variance assumed.

        Minus twice the logarithm of the likelihood of all that no start explains (restricted
        maximum likelihood), about the path of the last :meth:`rows`.

        Args:
            shares: (s,) to compare.

        """
        assert self._last is not None
        known = np.tile(self._noise, len(self._steps))[self._last.chosen]
        slipped = self._last.root @ self._last.root.T / np.outer(known, known)
        variances, axes = np.linalg.eigh(slipped)
        left = np.column_stack([self._last.start, self._last.error]) / known[:, None]
        left = axes.T @ left
        found = []
        for share in shares:
            variance = 1.0 + share * np.maximum(variances - 1.0, 0.0)
            white = left / np.sqrt(variance)[:, None]
            _, factor = np.linalg.qr(white)
            by_start = np.log(np.abs(np.diag(factor)[:3])).sum()
            found.append(np.log(variance).sum() + 2.0 * by_start + factor[3, 3] ** 2)
        return np.array(found)

    def drop_outliers(self, values: Array) -> int:
        """Leave out references that err beyond belief, the worst first; return how many.

        Each is judged by what all others and the wheels predict of it, whatever the start: slip
        that adds up on the way would hide it from a prediction by the wheels alone.
        """
        linear = self._linear(values)
        size = len(linear.error)
        white = np.linalg.solve(
            linear.root, np.column_stack([np.eye(size), linear.error, linear.start])
        )
        basis, _ = np.linalg.qr(white[:, -3:])
        information = white[:, :size].T @ (white - basis @ (basis.T @ white))[:, : size + 1]
        owner = np.flatnonzero(linear.chosen) // 3
        left = np.ones(size, dtype=bool)
        dropped = 0
        while left.sum() > FEWEST:
            own = np.maximum(np.diag(information), 1e-12)
            far = np.where(left, np.abs(information[:, -1]) / np.sqrt(own), 0.0)
            usual = max(float(np.median(far[left])) / MEDIAN, 1.0)
            if far.max() <= OUTLIER * usual:
                break
            gone = owner == owner[far.argmax()]
            gain = np.linalg.solve(information[:, :-1][np.ix_(gone, gone)], information[gone])
            information = information - information[:, :-1][:, gone] @ gain
            left &= ~gone
            self._known[:, owner[far.argmax()]] = False
            dropped += 1
        return dropped

    def _linear(self, values: Array) -> _Linear:
        """Return errors and derivatives about the path that start, slip and values make."""
        poses = self._poses(values)
        chosen = self._known.T.flatten()
        levers, adjoint = self._levers(poses), adjoint_columns(poses)
        moved = np.concatenate([self._displaced(values), self._slip[None]])
        slope = self._at_references(moved, levers, adjoint)
        error = self._errors(poses[:, self._steps]).T.ravel() + slope[:, -1]
        root = np.linalg.cholesky(self._covariance(levers, adjoint)[np.ix_(chosen, chosen)])
        return _Linear(
            slope[chosen, :-1],
            levers.reshape(-1, 3)[chosen],
            error[chosen],
            np.asarray(root, dtype=np.float64),
            levers,
            adjoint,
            chosen,
        )

    def _poses(self, values: Array) -> Array:
        moved = self._model.displacement(values, self._turned, self._steering)
        return pose_columns(moved + self._slip, self._start)

    def _errors(self, predicted: Array) -> Array:
        """Return (3, k) reference less prediction; 0 where the reference is not known."""
        error = self._reference - predicted
        error[2] = (error[2] + np.pi) % (2.0 * np.pi) - np.pi
        return np.where(self._known, error, 0.0)

    def _displaced(self, values: Array) -> Array:
        """Return (p, 3, m) derivative of the displacements by the unknowns."""
        columns = []
        for i, unknown in enumerate(self._model.unknowns):
            step = np.zeros(len(values))
            step[i] = STEP * unknown.doubt
            ahead, behind = (
                self._model.displacement(near, self._turned, self._steering)
                for near in (values + step, values - step)
            )
            columns.append((ahead - behind) / (2.0 * step[i]))
        return np.array(columns)

    def _at_references(self, moved: Array, levers: Array, adjoint: Array) -> Array:
        """Return (3 k, q) what q small motions of the base, (q, 3, m), do to the predictions."""
        world = np.cumsum(np.einsum('mij,qjm->qmi', adjoint, moved), axis=1)
        world = np.concatenate([np.zeros((len(moved), 1, 3)), world], axis=1)[:, self._steps]
        predicted: Array = np.einsum('kij,qkj->kiq', levers, world)
        return predicted.reshape(-1, len(moved))

    def _levers(self, poses: Array) -> Array:
        """Return (k, 3, 3) what a small motion of the world does to each predicted pose."""
        x, y, _ = poses[:, self._steps]
        levers = np.tile(np.eye(3), (len(x), 1, 1))
        levers[:, 0, 2], levers[:, 1, 2] = -y, x
        return levers

    def _covariance(self, levers: Array, adjoint: Array) -> Array:
        """Return (3 k, 3 k) covariance of the errors at all references."""
        walked = noise_columns(adjoint, self._unit, self._variance)[self._steps]
        count = len(levers)
        both = np.einsum('jab,lcb->jalc', levers @ walked, levers)
        earlier = np.arange(count)[:, None, None, None] <= np.arange(count)[None, None, :, None]
        covariance = np.where(earlier, both, both.transpose(2, 3, 0, 1))
        flat: Array = covariance.reshape(3 * count, 3 * count)
        return flat + np.diag(np.tile(self._noise**2, count))

    def _first_start(self) -> Pose:
        """Return the start from which the nominal wheels pass the references most closely."""
        nominal = np.array([unknown.nominal for unknown in self._model.unknowns])
        moved = self._model.displacement(nominal, self._turned, self._steering)
        x, y, heading = pose_columns(moved)[:, self._steps]
        along, across = x - x.mean(), y - y.mean()
        to_x, to_y, measured = self._reference
        turn = np.arctan2(along @ to_y - across @ to_x, along @ to_x + across @ to_y)
        if np.isfinite(measured).any():
            off = (measured - heading)[np.isfinite(measured)]
            turn = np.arctan2(np.sin(off).mean(), np.cos(off).mean())
        c, s = np.cos(turn), np.sin(turn)
        return Pose(
            float(to_x.mean() - c * x.mean() + s * y.mean()),
            float(to_y.mean() - s * x.mean() - c * y.mean()),
            float(turn),
        )
