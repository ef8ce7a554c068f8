"""A chain on a terminal: 80 columns, level in a word, the way to the cause marked."""

from __future__ import annotations

import json

from agv_motion.explanation import lines
from agv_motion.explanation.text import plain

NOON = 1434369600.0


def off(robot):
    robot.rest('probes', 'resting: a probe cannot be believed')
    robot.probes = 1, 'resting: probe_2 is off', robot.probes[2] | {
        'probe_2 condition': 'off', 'probe_2 since [s]': '1434369720.0', 'probe_2 dT [K]': '0.81',
    }  # fmt: skip
    return robot.tell()


def test_a_chain_fits_into_80_columns_and_says_all(robot):
    told = lines('oak', off(robot), NOON + 600.0, time_zone='Europe/Paris')
    text = '\n'.join(line for _, line in told)
    assert max(len(line) for _, line in told) <= 80
    assert text.startswith(
        'oak: wheels stand: cmd_vel is zero: resting: probe 2 is off since 14:02: look at\n'
        '  its heater\n'
    )
    assert '> probe_2   WARN  probe 2 is off since 14:02, dT 0.81 K, sap flow 0.42; is s2' in text
    assert '                  -> look at its heater' in text
    assert '  probe_1   ok    probe 1 is good, sap flow 0.79; is s1' in text
    assert '> decision  WARN  resting: a probe cannot be believed; since 13:59' in text
    assert {level for level, line in told if 'probe_2' in line} == {1}


def test_old_news_is_told_with_its_age(robot):
    robot.tell()
    robot.silent = {'granier_probe'}
    for _ in range(10):
        chain = robot.tell()
    text = ' '.join(' '.join(line for _, line in lines('oak', chain, NOON)).split())
    assert 'sap flow ERROR granier_probe is silent for 5.0 s' in text
    assert 'probe 1 is good, sap flow 0.79; is s1; since 12:00; 5.0 s old' in text


def test_as_objects_it_is_json_with_the_same_words(robot):
    chain = off(robot)
    told = json.loads(json.dumps(plain('oak', chain)))
    assert told['headline'] == chain.headline
    assert (told['level'], told['cause'], told['remedy']) == (
        'WARN',
        'probe_2',
        'look at its heater',
    )
    assert [link['name'] for link in told['links']] == [link.name for link in chain.links]
    assert told['links'][0]['level'] == 'OK'
