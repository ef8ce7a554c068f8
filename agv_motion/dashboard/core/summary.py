"""One colour, one word and one sentence for each robot: the sentence is the robot's own.

Green: it moves or rests as it should. Yellow: something waits, or is degraded. Red: something
stands that should not, or what is known is old.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.numbers import text_of
from agv_motion.dashboard.core.robot_state import MEASURED

if TYPE_CHECKING:
    from agv_motion.dashboard.core.robot_state import RobotState

OLD = 2.0
"""[s] after which what was measured is old"""
GREEN, YELLOW, RED = 'green', 'yellow', 'red'
COLOURS = {
    'walking': GREEN, 'turning': GREEN, 'resting': GREEN, 'closed': GREEN, 'driven': GREEN,
    'driving': GREEN, 'arrived': GREEN, 'starting': YELLOW, 'waiting': YELLOW, 'paused': YELLOW,
    'blocked': RED, 'stopped': RED, 'failed': RED, 'silent': RED,
}  # fmt: skip
"""of each activity; of one that is not known: yellow"""
BY_HAND = ('manual',)
ASKED = 'asked'
"""what a tree tells as its hours while it rests until a time that somebody named"""
NOBODY = {'driver': '', 'stop': False, 'sentence': '', 'lost': '', 'level': 'OK'}
"""what `driver` tells of a robot that has none"""
STATES = ('state', 'sequence/state', 'sequence/status', 'route/state', 'ghost/state')


class _Found(NamedTuple):
    word: str
    colour: str
    sentence: str


def summary(robot: RobotState, now: float) -> dict[str, Any]:
    """Return the summary of a robot at a time of the board [s]; keeps since when it is so."""
    driver = _driver(robot)
    found = _found(robot, driver, now)
    if found.word != robot.word:
        robot.word, robot.word_since = found.word, now
    return {
        'kind': robot.kind,
        'colour': found.colour,
        'word': found.word,
        'sentence': found.sentence,
        'moving': robot.moves(),
        'stopped': bool(driver['stop']),
        'standstill': robot.stands(),
        'driver': driver['driver'],
        'rest_asked': _value(robot, 'hours', now) == ASKED,
        'since': round(robot.word_since, 2),
    }


def _driver(robot: RobotState) -> dict[str, Any]:
    told: dict[str, Any] | None = robot.converted('driver', conversions.driver)
    return NOBODY if told is None else told


def _found(robot: RobotState, driver: dict[str, Any], now: float) -> _Found:
    old = old_inputs(robot, now)
    if old and len(old) == len([topic for topic in MEASURED if topic in robot.latest]):
        age = min(old.values())
        return _Found('silent', RED, f'no data for {age:.0f} s')
    if not any(topic in robot.latest for topic in MEASURED):
        return _Found('silent', RED, 'no data yet')
    word, colour, sentence = _activity(robot, driver, now)
    if old:
        topic, age = max(old.items(), key=lambda item: item[1])
        return _Found(word, RED, f'{topic} is {age:.0f} s old; {sentence}'.rstrip('; '))
    return _Found(word, colour, sentence)


def _activity(robot: RobotState, driver: dict[str, Any], now: float) -> _Found:
    """Return what a robot does whose measurements are fresh."""
    sentence = said(robot)
    if driver['stop']:
        return _Found('stopped', RED, driver['sentence'] or sentence)
    if driver['lost']:
        return _Found('stopped', RED, driver['sentence'] or sentence)
    if driver['driver'] in BY_HAND:
        return _Found('driven', YELLOW, driver['sentence'] or sentence)
    worst, told = worst_node(robot, now)
    word = activity(robot, now)
    if not word:
        word = 'driven' if robot.moves() else 'resting'
    colour = COLOURS.get(word, YELLOW)
    if worst == 'ERROR':
        return _Found(word, RED, sentence or told)
    if worst in {'WARN', 'STALE'} and colour == GREEN:
        colour = YELLOW
    return _Found(word, colour, sentence or driver['sentence'] or told)


def activity(robot: RobotState, now: float) -> str:
    """Return the word of the motion generator for what it does; empty if none is known."""
    return _value(robot, 'activity', now)


def _value(robot: RobotState, key: str, now: float) -> str:
    """Return what the first node that tells something under a key tells; empty if none does."""
    for node in robot.nodes.values():
        word = node.told['values'].get(key, '')
        if word and not node.is_old(now):
            return text_of(word, 40)
    return ''


def said(robot: RobotState) -> str:
    """Return the sentence of a robot: the head of its reasons, or its state."""
    chain = robot.converted('why', conversions.why)
    if chain is not None:
        for one in chain['links']:
            if one['name'] in {'headline', 'why'} and one['sentence']:
                return str(one['sentence'])
    for topic in STATES:
        message = robot.message(topic)
        text = getattr(message, 'data', None) or getattr(message, 'message', None)
        if text:
            return text_of(text)
    return ''


def worst_node(robot: RobotState, now: float) -> tuple[str, str]:
    """Return the worst level among the nodes of a robot, and what that node says."""
    order = ['OK', 'WARN', 'STALE', 'ERROR']
    worst, sentence = 'OK', ''
    for node in robot.nodes.values():
        level = 'STALE' if node.is_old(now) else node.told['level']
        if order.index(level) > order.index(worst) or not sentence:
            worst, sentence = level, node.told['message']
    return worst, sentence


def old_inputs(robot: RobotState, now: float) -> dict[str, float]:
    """Return what is measured all the time and is old: its age [s] by topic."""
    ages = {topic: robot.age(topic, now) for topic in MEASURED}
    return {topic: age for topic, age in ages.items() if age is not None and age > OLD}
