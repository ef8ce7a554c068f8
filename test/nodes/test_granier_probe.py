"""Node `granier_probe` over a real graph: sources, validity, what is learnt."""

from __future__ import annotations

import json

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import Vector3Stamped
from rclpy.exceptions import InvalidParameterValueException
from sensor_msgs.msg import Illuminance, Temperature
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import StartError
from agv_motion.saved_state import load

DAWN = 1_370_822_400
"""[s] since 1970: the tenth of June 2013"""
QUICK = {'rate': 20.0, 'simulated__period': 0.1}


def test_three_probes_become_one_sap_flow(tester):
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    raw = tester.listen(Temperature, 'granier/probe_2/temperature_difference', SENSOR)
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    tester.start(GranierProbe, **QUICK)
    vector = tester.wait(flows).vector
    assert all(0.0 <= s <= 1.0 for s in (vector.x, vector.y, vector.z))
    assert 15.0 < tester.wait(raw).temperature < 25.0
    assert tester.wait(valid).data
    assert flows[0].header.stamp.sec > 0


def test_without_history_it_says_why_it_rests(tester):
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    node = tester.start(GranierProbe, warm_up_days=0.0, **QUICK)
    assert not tester.wait(valid).data
    assert 'probe_1 is learning' in node.plain.diagnose().message


def table(tmp_path, rows):
    path = tmp_path / 'probes.csv'
    path.write_text('time,probe_1,probe_2,probe_3\n' + rows)
    return str(path)


def clear_week(tmp_path, extra=''):
    """Readings every 15 min for three days, then ``extra``."""
    rows = ''.join(
        f'{DAWN + 900 * k},{v},{v},{v}\n'
        for k in range(288)
        for v in [0.8 - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0) + 1e-4 * (k % 3)]
    )
    return table(tmp_path, rows + extra)


def test_a_recording_plays_with_its_past_learnt(tester, tmp_path):
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    file = clear_week(tmp_path)
    start = '2013-06-12T13:00:00'
    tester.start(GranierProbe, source='csv', rate=20.0, csv__file=file, csv__start=start)
    assert tester.wait(flows).vector.x > 0.5


def test_a_probe_that_goes_off_ends_the_sap_flow(tester, tmp_path):
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    file = clear_week(tmp_path, f'{DAWN + 259200},0.8,0.001,0.8\n')
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=file, csv__speed=3600.0,
        csv__start='2013-06-12T23:00:00',
    )  # fmt: skip
    assert tester.wait(valid, lambda m: m.data)
    tester.wait(valid, lambda m: not m.data)
    assert 'probe_2 is off' in node.plain.diagnose().message


def test_a_lost_probe_goes_down_its_ladder_and_that_is_told(tester, tmp_path):
    """Held for a reading of the file, then nothing is known: a quarter of an hour each."""
    states = tester.listen(String, 'granier/state', LATCHED)
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    rows = ''.join(f'{DAWN + 259200 + 900 * k},0.8,0.001,0.8\n' for k in range(40))
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=clear_week(tmp_path, rows),
        csv__speed=3600.0, csv__start='2013-06-12T23:00:00', probe__loss__hold=1200.0,
        probe__loss__trend=1200.0,
    )  # fmt: skip
    for step in ('held', 'by the trend of its last hour'):
        assert tester.wait(states, lambda m, s=step: m.data == f'probe_2 is off: {s}')
    assert tester.wait(valid, lambda m: not m.data)
    assert node.plain.diagnose().message == 'resting: probe_2 is off'
    assert node.plain.diagnose().values['probe_2 known by'] == 'lost'
    assert tester.wait(states, lambda m: not m.data)


def test_litres_are_told_with_their_interval(tester, tmp_path):
    """Eight hours of the third day are history, and count as of today."""
    now = tester.listen(Vector3Stamped, 'granier/water_use', SENSOR)
    today = tester.listen(Vector3Stamped, 'granier/water_use_today', SENSOR)
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=clear_week(tmp_path),
        csv__start='2013-06-12T13:00:00', water__sapwood_area=0.02,
    )  # fmt: skip
    rate, litres = tester.wait(now), tester.wait(today)
    assert rate.header.stamp.sec > 0
    for told in (rate.vector, litres.vector):
        assert 0.0 < told.y < told.x < told.z
    flux = node.plain._readings[0].flux_density  # noqa: SLF001 - diagnostics round it
    assert rate.vector.x == pytest.approx(0.02 * flux * 3600.0 * 1000.0)
    assert 1.0 < litres.vector.x / rate.vector.x < 5.0
    assert node.plain.diagnose().values['water use today known [h]'] == '13.00'


def test_zero_flow_by_the_air_and_an_unheated_probe(tester, tmp_path):
    """Nights of the first two days are dry; the air is told to who listens."""
    air = tester.listen(Vector3Stamped, 'granier/environment', SENSOR)
    rows = ''.join(
        f'{DAWN + 900 * k},{v},{v},{v},0.02,{max(0, 800 - abs(k % 96 - 50) * 30)},'
        f'{0.05 if k > 191 else 0.5}\n'
        for k in range(300)
        for v in [0.8 - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0) + 1e-4 * (k % 3)]
    )
    path = tmp_path / 'probes.csv'
    path.write_text('time,a,b,c,cold,sun,vpd\n' + rows)
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=str(path), csv__speed=3600.0,
        csv__columns=['a', 'b', 'c', 'cold'], csv__day_offsets=[0.0] * 4, warm_up_days=8.0,
        csv__radiation_column='sun', csv__vpd_column='vpd', csv__start='2013-06-12T06:00:00',
        probe__zero_flow_method='environment', reference_probe='probe_4',
    )  # fmt: skip
    reading = lambda: node.plain._readings[0]  # noqa: SLF001, E731 - zero flow is told by diagnostics, rounded
    tester.graph.spin_until(lambda: reading() and reading().flow_index is not None)
    assert reading().zero_flow == pytest.approx(25.0 * (0.8 + 1e-4 - 0.02), abs=0.01)
    first = tester.wait(air).vector
    assert 0.0 <= first.x <= 800.0
    assert first.y == 0.05


def test_a_gap_ends_the_sap_flow(tester, tmp_path):
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    file = clear_week(tmp_path, f'{DAWN + 864000},0.8,0.8,0.8\n')
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=file, csv__speed=9000.0,
        csv__start='2013-06-12T23:00:00',
    )  # fmt: skip
    tester.wait(valid, lambda m: m.data)
    tester.wait(valid, lambda m: not m.data)
    assert 'no reading for' in node.plain.diagnose().message


def test_a_logger_that_falls_silent_goes_down_the_ladder_too(tester, tmp_path):
    """The gap is known for one after 0.3 s; what was last read is held for 3 s, then it rests."""
    states = tester.listen(String, 'granier/state', LATCHED)
    valid = tester.listen(Bool, 'granier/valid', LATCHED)
    file = clear_week(tmp_path, f'{DAWN + 864000},0.8,0.8,0.8\n')
    node = tester.start(
        GranierProbe, source='csv', rate=20.0, csv__file=file, csv__speed=9000.0,
        csv__start='2013-06-12T23:00:00', probe__loss__hold=27000.0,
    )  # fmt: skip
    held = '; '.join(f'probe_{i} is missing: held' for i in (1, 2, 3))
    assert tester.wait(states, lambda m: m.data == held)
    assert [m.data for m in valid] == [True]
    tester.wait(valid, lambda m: not m.data)
    assert 'no reading for' in node.plain.diagnose().message
    assert node.plain.diagnose().values['probe_1 known by'] == 'lost'


def test_recalibration_is_a_service(tester):
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    tester.start(GranierProbe, **QUICK)
    tester.wait(flows)
    answer = tester.ask(Trigger, 'granier_probe/recalibrate', Trigger.Request())
    assert answer.success
    assert 'zero flow is now' in answer.message


def test_what_was_learnt_survives_a_restart(tester, tmp_path):
    path = tmp_path / 'state.json'
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    first = tester.start(GranierProbe, state_file=str(path), **QUICK)
    tester.wait(flows)
    first.trigger_shutdown()
    assert len(json.loads(load(path))['probes']) == 3
    flows.clear()
    tester.start(GranierProbe, state_file=str(path), warm_up_days=0.0, **QUICK)
    tester.wait(flows)


def test_a_state_that_is_damaged_is_set_aside_and_the_node_starts(tester, tmp_path, capfd):
    path = tmp_path / 'state.json'
    path.write_text('{"version": 1')
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    tester.start(GranierProbe, state_file=str(path), **QUICK)
    tester.wait(flows)
    assert 'set aside as state.json.unusable' in capfd.readouterr().err
    assert (tmp_path / 'state.json.unusable').read_text() == '{"version": 1'
    assert len(json.loads(load(path))['probes']) == 3


def test_a_folder_as_state_file_stops_the_start_and_stays(tester, tmp_path, capfd):
    with pytest.raises(StartError):
        tester.start(GranierProbe, state_file=str(tmp_path), **QUICK)
    assert 'is a folder: give a file in it' in capfd.readouterr().err
    assert tmp_path.is_dir()


def test_a_disk_that_takes_nothing_is_told_at_the_start(tester, tmp_path):
    (tmp_path / 'file').write_text('no folder')
    flows = tester.listen(Vector3Stamped, 'granier/sap_flow', SENSOR)
    node = tester.start(GranierProbe, state_file=str(tmp_path / 'file' / 'state'), **QUICK)
    assert 'cannot keep what was learnt' in node.complaint
    tester.wait(flows)


def test_shade_reaches_the_simulated_tree(tester):
    node = tester.start(GranierProbe, **QUICK)
    light = tester.publisher(Illuminance, 'sunlight', SENSOR)
    message = Illuminance(illuminance=20_000.0)
    message.header.stamp.sec = 1434369600  # 15 June 2015, noon
    light.publish(message)
    tester.graph.spin_until(lambda: node.plain._source._light < 0.3)  # noqa: SLF001 - it shows nowhere else so soon


@pytest.mark.parametrize(
    ('parameters', 'error', 'word'),
    [
        ({'source': 'crystal_ball'}, ConfigurationError, 'simulated, csv, serial, mqtt'),
        ({'assign': ['probe_1', 'probe_2', 'probe_9']}, ConfigurationError, 'probe_9'),
        ({'probe__low_quantile': 0.99}, ConfigurationError, 'not below'),
        ({'rate': -1.0}, InvalidParameterValueException, 'rate'),
        ({'csv__day_offsets': [1.0]}, ConfigurationError, '3 columns and 1 day_offsets'),
        ({'csv__vpd_column': 'probe_1'}, ConfigurationError, 'give each a column of its own'),
        ({'reference_probe': 'probe_1'}, ConfigurationError, 'since it is not heated'),
        ({'probe__calibration__of': 'oak'}, ConfigurationError, 'picea_abies'),
        (
            {'probe__zero_flow_method': 'environment', 'source': 'csv'},
            ConfigurationError,
            'give csv.radiation_column',
        ),
        (
            {
                'probe__zero_flow_method': 'environment',
                'probe__environment__vpd_below': 0.0,
                'probe__environment__radiation_below': 0.0,
            },
            ConfigurationError,
            'asks nothing',
        ),
    ],
)
def test_parameters_that_make_no_sense_are_refused(tester, parameters, error, word):
    with pytest.raises(error, match=word):
        tester.start(GranierProbe, **parameters)


def test_a_missing_column_stops_the_start_and_names_those_there_are(tester, tmp_path, capfd):
    path = tmp_path / 'other.csv'
    path.write_text('time,voltage\n2013-06-10,1\n')
    with pytest.raises(StartError):
        tester.start(GranierProbe, source='csv', csv__file=str(path))
    assert "no column 'probe_1': it has time, voltage" in capfd.readouterr().err
