"""What the omni demo has shown: estimate, fixes and odometry against the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from rich.table import Table

from agv_motion.report.stamped_columns import PoseColumns, pose_columns

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader

    Array = NDArray[np.float64]

TOPICS = ('/ground_truth', '/pose', '/fix', '/odom')
OUTLIER = 0.15 * 5.0
"""[m] Error of a fix that is counted as an outlier in the table."""
ELLIPSE = np.sqrt(5.991)
"""[-] Radius of the ellipse in which the truth lies with 95 %."""


class LocalizationRun(NamedTuple):
    """A drive; all stamps in seconds since its start."""

    truth: PoseColumns
    pose: PoseColumns
    fix: PoseColumns
    odom: PoseColumns

    def error(self, of: PoseColumns) -> Array:
        """Return (3, n) columns less the truth at their times: x, y [m] and heading [rad]."""
        x, y, heading = self.truth.pose
        unwrapped = np.unwrap(heading)
        there = [np.interp(of.stamp, self.truth.stamp, line) for line in (x, y, unwrapped)]
        wrong: Array = of.pose - np.array(there)
        wrong[2] = (wrong[2] + np.pi) % (2.0 * np.pi) - np.pi
        return wrong

    def odometry_alone(self) -> PoseColumns:
        """Return odometry laid into the map so that it begins at the truth."""
        (x, y, heading), (x0, y0, heading0) = self.odom.pose, self.truth.pose[:, 0]
        turn = heading0 - heading[0]
        c, s = np.cos(turn), np.sin(turn)
        dx, dy = x - x[0], y - y[0]
        laid = np.array([x0 + c * dx - s * dy, y0 + s * dx + c * dy, heading + turn])
        return PoseColumns(self.odom.stamp, laid, self.odom.covariance)


def read_localization(bag: BagReader) -> LocalizationRun:
    """Read the bag back."""
    columns = pose_columns(bag, TOPICS)
    begin = columns[0].stamp[0]
    return LocalizationRun(*(c._replace(stamp=c.stamp - begin) for c in columns))


def summary(run: LocalizationRun) -> Table:
    """Return the figures of a run as a table."""
    table = Table(title='The drive', show_header=False, title_justify='left', box=None)
    fixes, told = np.hypot(*run.error(run.fix)[:2]), np.hypot(*run.error(run.pose)[:2])
    sound = fixes[fixes < OUTLIER]
    alone = run.error(run.odometry_alone())
    way = np.hypot(*np.diff(run.truth.pose[:2], axis=1)).sum()
    table.add_row('distance', f'{way:.1f} m in {run.truth.stamp[-1]:.0f} s')
    table.add_row(
        'fixes', f'{len(fixes)}, {np.mean(fixes >= OUTLIER) * 100:.0f} % outliers, the others err '
        f'{100 * np.sqrt(np.mean(sound**2)):.1f} cm (root mean square)',
    )  # fmt: skip
    if not len(told):
        table.add_row('pose', 'never told: position or heading was not known')
        return table
    table.add_row(
        'pose', f'told {100 * len(told) / len(run.odom.stamp):.0f} % of the time, errs '
        f'{100 * np.median(told):.1f} cm in the median, {100 * np.percentile(told, 95):.1f} cm '
        'in the worst twentieth',
    )  # fmt: skip
    table.add_row('inside its 95 % ellipse', f'{100 * _inside(run):.0f} % of the time')
    table.add_row(
        'odometry alone',
        f'ends {np.hypot(*alone[:2, -1]):.2f} m and {np.degrees(abs(alone[2, -1])):.0f} deg off',
    )
    return table


def _inside(run: LocalizationRun) -> float:
    """Return the share of the time in which the truth lay inside the ellipse."""
    x, y, _ = run.error(run.pose)
    xx, xy, _, yy, _, _ = run.pose.covariance
    square = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / (xx * yy - xy * xy)
    return float(np.mean(square <= ELLIPSE**2))
