"""The picture of a drive beside its truth, and when it was carried."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from agv_motion.report.localization import LocalizationRun
from agv_motion.report.localization_figure import carried
from agv_motion.report.localization_figure import draw as draw_localization
from agv_motion.report.localization_figure import finding as localization_finding
from agv_motion.report.stamped_columns import PoseColumns

RECORDED = Path(__file__).parent / 'recorded'


def recorded_drive():
    with np.load(RECORDED / 'omni.npz') as held:
        return LocalizationRun(
            *(
                PoseColumns(*(held[f'{name}_{part}'] for part in PoseColumns._fields))
                for name in LocalizationRun._fields
            )
        )


def test_the_drive_of_the_omni_robot(sketched, tmp_path):
    draw_localization(recorded_drive(), tmp_path / 'path.png')
    sketched.check()
    texts = [text for text, _ in sketched[-1][1]]
    events = {'carried away', 'found again after 11 s', 'start', 'end', 'set down', 'found again'}
    assert events <= set(texts)
    assert texts.count('carried away') == 2


def test_when_it_was_carried_and_found_again_by_hand():
    """It stands at 0 m, is set down at 5 m after 3 s, and believes so after 5 s."""
    stamp = np.arange(8.0)
    truth = np.array([[0.0] * 3 + [5.0] * 5, [0.0] * 8, [0.0] * 8])
    believed = np.array([[0.0] * 5 + [5.0] * 3, [0.0] * 8, [0.0] * 8])
    there, told = (PoseColumns(stamp, pose, np.zeros((6, 8))) for pose in (truth, believed))
    run = LocalizationRun(there, told, told, told)
    assert carried(run) == (3.0, 5.0)
    assert localization_finding(run).endswith('it finds itself again after 2 s')
    never = run._replace(pose=told._replace(pose=0.0 * believed))
    assert localization_finding(never).endswith('it did not find itself again')
    assert carried(run._replace(truth=told._replace(pose=0.0 * truth))) is None
