"""What goes on until Ctrl-C, in a real terminal: lines that fit, a sane terminal after it."""

from __future__ import annotations

import re

import pytest

pytest.importorskip('rclpy')

SPREAD = r' +min: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d\.\d{5}s window: \d+'
LINES = {
    'hz': rf'average rate: \d+\.\d{{3}}|{SPREAD}',
    'bw': r'Subscribed to .*|\d+(\.\d\d)? K?B/s from \d+ messages| +Message size mean: .*',
    'delay': rf'average delay: \d+\.\d{{3}}|{SPREAD}',
    'echo': r'header:|  stamp:|    n?a?n?o?sec: \d+|  frame_id: .*|point:|  [xyz]: -?\d\.\d+|---',
}
"""All that each may say"""
WORDS = '/way', 'geometry_msgs/msg/PointStamped', '{header: auto, point: {x: -0.0001, y: 2.5}}'


def test_live_output_in_a_terminal_until_ctrl_c(alone, terminal):
    talker = alone.start('topic', 'pub', '-r', '20', '-p', '100000', *WORDS)
    screens = {word: terminal('topic', word, '/way') for word in LINES}
    for word, screen in screens.items():
        screen.wait(lambda text, word=word: len(re.findall(LINES[word], text)) > 3)
    for screen in screens.values():
        screen.press(b'\x03')
    for word, screen in screens.items():
        status, told = screen.end()
        assert status == 0, told
        lines = [line for line in told.replace('^C', '').splitlines() if line.strip()]
        allowed = re.compile(f'{LINES[word]}|WARNING: .* yet')
        assert [line for line in lines if not allowed.fullmatch(line)] == []
        assert max(map(len, lines)) < 80
    talker.terminate()
    talker.communicate()
