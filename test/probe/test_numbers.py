"""Numbers of this room: what nobody told is nothing, a number changes on purpose only."""

from __future__ import annotations

from math import nan, pi

from room_numbers import constants, defaults

from agv_motion.probe.sources.logger_line import MISSING
from agv_motion.probe.tables.time_readers import USUAL

CONSTANTS = {
    'damping.DAY': 86_400.0,
    'damping.LEFT': 0.1,
    'environment.COVERED': 0.75,
    'environment.UNKNOWN': (nan, nan),
    'granier.COEFFICIENT': 0.00011899,
    'granier.EXPONENT': 1.231,
    'loss.HOUR': 3600.0,
    'loss.KEPT': 21_600.0,
    'natural_gradient.LARGEST': 5.0,
    'noise.DOUBTFUL': 14,
    'noise.MOST': 4,
    'noise.WINDOW': 7,
    'normalise.TINY': 1e-12,
    'probe.FLOWING': 0.02,
    'quality.FORGET': 21_600.0,
    'quality.RECENT': 5,
    'quality.STEP': 3,
    'signals.HALF': 0.5,
    'signals.NEUTRAL': (0.0, 0.5, 0.5),
    'sources.attempts.LONGEST_PAUSE': 30.0,
    'sources.csv_file.AHEAD': 86_400.0,
    'sources.csv_recording.DAY': 86_400.0,
    'sources.csv_recording.ROUNDED': 0.001,
    'sources.line_listener.GARBAGE': 0.3,
    'sources.line_listener.MOST_TOLD': 3,
    'sources.logger_clock.OFF_CLOCK': 86_400.0,
    'sources.line_listener.SILENT': 3.0,
    'sources.logger_line.EPOCHS': (1_000_000_000.0, 3_100_000_000.0),
    'sources.logger_line.LONGEST_LINE': 1024,
    'sources.logger_line.YEARS': (2001, 2069),
    'sources.mqtt_connection.CONNECT_LIMIT': 4.0,
    'sources.mqtt_connection.LONGEST_PAYLOAD': 65_536,
    'sources.mqtt_connection.MOST_WAITING': 10_000,
    'sources.mqtt_connection.TICK': 0.2,
    'sources.mqtt_parameters.LONGEST_TOPIC': 65_535,
    'sources.recorded.PATIENCE': 0.5,
    'sources.simulated.DAY': 86_400.0,
    'sources.simulated.HOURS': 12.0 / pi,
    'sources.simulated.STOMATAL_LAG': 900.0,
    'sources.source.KELVIN_PER_MILLIVOLT': 25.0,
    'sources.source.MOST': 100_000.0,
    'state_file.VALUES': 500_000,
    'state_file.VERSION': 1,
    'tables.clock_resets.BEGINNINGS': (631_152_000.0, 946_684_800.0),
    'tables.clock_resets.YEAR': 31_536_000.0,
    'tables.description.GAP': 1.5,
    'tables.description.KELVIN': (2.5, 30.0),
    'tables.description.MILLIVOLT': (0.05, 2.5),
    'tables.file_text.LOOKED_AT': 4096,
    'tables.file_text.MOST_ODD': 0.02,
    'tables.inspection.HEAD_BYTES': 262_144,
    'tables.inspection.IN_A_ROW': 3,
    'tables.inspection.LOOKED_AT': 400,
    'tables.inspection.MOST': 0.6,
    'tables.inspection.PARTS': (6, 5, 4, 3, 2),
    'tables.left_out.MOST_TOLD': 3,
    'tables.table_file.CELLS': 65_536,
    'tables.table_file.LARGEST': 134_217_728,
    'tables.table_file.TAIL': 64,
    'tables.table_form.HEAD': 100,
    'tables.table_rows.ENOUGH': 3,
    'tables.table_rows.UNIT_ROWS': 3,
    'tables.time_format.LOOKED_AT': 400,
    'tables.time_format.MAJORITY': 10,
    'tables.time_readers.DAY': 86_400.0,
    'tables.time_readers.EARLIEST': 631_152_000.0,
    'tables.time_readers.EXCEL_1904_EPOCH': 24_107.0,
    'tables.time_readers.EXCEL_EPOCH': 25_569.0,
    'tables.time_readers.LATEST': 4_102_444_800.0,
    'tables.time_readers.MATLAB_EPOCH': 719_529.0,
    'tables.time_readers.MOST_AHEAD': 50_400.0,
    'water.DAY': 86_400.0,
    'water.HOUR': 3600.0,
    'water.LITRES': 1000.0,
    'water.LONGEST_GAP': 3600.0,
    'water.NORMAL_95': 1.959963984540054,
    'zero_flow.DAY': 86_400.0,
    'zero_flow.HIGHEST': 1.1,
    'zero_flow.LOWEST': 0.8,
    'zero_flow_method.ROUNDED': 1e-10,
}

DEFAULTS = {
    'calibration.CalibrationParameters': {
        'coefficient': 0.00011899, 'exponent': 1.231, 'spread': 0.58,
    },
    'damping.DampingParameters': {'a': 1.0},
    'environment.Environment': {'radiation': nan, 'vapour_pressure_deficit': nan},
    'environment.EnvironmentParameters': {
        'radiation_below': 30.0, 'vpd_below': 0.1, 'variation_below': 0.5, 'hours': 2.0, 'days': 30,
    },
    'loss.LossParameters': {'climatology_days': 7, 'enough': 3},
    'normalise.RunningQuantiles': {'learning_hours': 24.0, 'bin_length': 900.0},
    'parameters.ProbeParameters': {
        'window_days': 7.0, 'low_quantile': 0.1, 'high_quantile': 0.95, 'smallest_range': 2e-06,
        'learning_hours': 24.0, 'opening_range': 2.5, 'night_start': 2.0, 'night_end': 7.0,
        'zero_flow_days': 3, 'off_below': 5.0, 'highest': 60.0, 'highest_index': 2.0,
        'spike_threshold': 0.15, 'stuck_flowing': 4.0, 'stuck_resting': 18.0, 'noise_above': 0.015,
        'settling': 2700.0, 'needle_in_sapwood': 1.0,
    },
    'probe.Probe.update': {'environment': (nan, nan)},
    'quality.ReadingJudge': {'noise_above': 0.015},
    'sources.csv_parameters.CsvParameters': {
        'day_offsets': (0.0, 0.0, 0.0), 'kelvin_per_millivolt': 25.0, 'speed': 1.0,
    },
    'sources.line_reading.LineParameters': {
        'fields': (1, 2, 3), 'kelvin_per_millivolt': 25.0, 'period': 30.0,
    },
    'sources.mqtt_parameters.MqttParameters': {
        'fields': (1, 2, 3), 'kelvin_per_millivolt': 25.0, 'period': 30.0, 'port': 1883, 'qos': 1,
        'keep_alive': 30, 'max_age': 600.0,
    },
    'sources.serial_line.SerialParameters': {
        'fields': (1, 2, 3), 'kelvin_per_millivolt': 25.0, 'period': 30.0, 'baud': 38400,
    },
    'sources.simulated.SimulatedSourceParameters': {
        'probes': 3, 'period': 25.0, 'seed': 1, 'latitude': 48.86, 'solar_offset': 0.16,
        'zero_flow': 20.0, 'fair_day_index': 0.12, 'noise': 0.01, 'drift': 0.3,
    },
    'sources.source.ProbeSample': {
        'environment': (nan, nan),
    },
    'sources.source.kelvin_per': {'kelvin_per_millivolt': 25.0},
    'sources.sources.SourceKind': {'has_logger': True},
    'sources.sources.SourceParameters': {'warm_up_days': 8.0},
    'tables.file_text.lines_of': {'first': 1},
    'water.WaterParameters': {'area_spread': 0.1, 'zero_flow_spread': 0.1},
    'zero_flow.ZeroFlow.update': {
        'environment': (nan, nan),
    },
}  # fmt: skip


def test_numbers_change_on_purpose_only():
    assert constants('probe') == CONSTANTS
    assert sorted(MISSING) == [-99_999.0, -9999.0, -7999.0, -6999.0, 6999.0, 7999.0]
    assert USUAL == [16, 19, 20]


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('probe') == DEFAULTS
