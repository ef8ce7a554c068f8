"""Frames of a robot get its prefix once, however they are given; those of the map never."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.model.frames import FrameParameters, in_namespace
from agv_motion.parameters import Spec


@dataclass(frozen=True)
class LocatedParameters(FrameParameters):
    """As those of a node that needs all frames."""

    odom_frame: Annotated[str, Spec('odometry')] = 'odom'
    imu_frame: Annotated[str, Spec('gyroscope')] = 'imu_link'
    map_frame: Annotated[str, Spec('map')] = 'map'


def placed(namespace='/oak', **given):
    return LocatedParameters(**given).in_namespace(namespace)


@pytest.mark.parametrize(
    ('namespace', 'prefix'), [('/', ''), ('/oak', 'oak/'), ('/farm/oak', 'farm/oak/')]
)
def test_the_namespace_is_the_prefix(namespace, prefix):
    found = placed(namespace)
    assert found.base_frame == f'{prefix}base_link'
    assert found.odom_frame == f'{prefix}odom'
    assert found.imu_frame == f'{prefix}imu_link'
    assert found.map_frame == 'map'
    assert found.own('turret_0') == f'{prefix}turret_0'


@pytest.mark.parametrize(
    ('given', 'prefix'),
    [('oak/', 'oak/'), ('/oak/', 'oak/'), ('pine_', 'pine_'), ('/', ''), ('//', '')],
)
def test_a_prefix_that_is_given_counts_instead(given, prefix):
    assert placed('/ash', frame_prefix=given).base_frame == f'{prefix}base_link'


@pytest.mark.parametrize('name', ['base_link', '/base_link', 'oak/base_link', '/oak/base_link'])
def test_a_slash_and_a_prefix_that_are_there_add_nothing(name):
    found = placed(base_frame=name)
    assert found.base_frame == 'oak/base_link'
    assert found.own(name) == 'oak/base_link'
    assert found.in_namespace('/oak') == found


def test_a_shared_frame_loses_its_slash_and_a_frame_that_is_not_told_stays_so():
    assert placed(map_frame='/site/map').map_frame == 'site/map'
    assert placed().own('') == ''


def test_nothing_stays_nothing_when_placed_again():
    found = placed(frame_prefix='/')
    assert found.in_namespace('/oak').base_frame == 'base_link'


@pytest.mark.parametrize('given', [{'base_frame': ''}, {'odom_frame': '/'}, {'map_frame': ''}])
def test_a_frame_without_a_name_is_refused(given):
    with pytest.raises(ConfigurationError, match='give the frame a name'):
        placed(**given)


@pytest.mark.parametrize(
    'given',
    [{'odom_frame': 'base_link'}, {'map_frame': 'oak/odom'}, {'base_frame': '/oak/odom'}],
)
def test_a_frame_that_would_hold_itself_is_refused(given):
    with pytest.raises(ConfigurationError, match=r"are both 'oak/.*a frame cannot hold itself"):
        placed(**given)


def test_a_gyroscope_may_sit_in_the_base():
    assert placed(imu_frame='base_link').imu_frame == 'oak/base_link'


def test_parameters_without_frames_stay_as_they_are():
    assert in_namespace(3, '/oak') == 3
