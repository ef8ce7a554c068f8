"""A choice in plain English."""

from __future__ import annotations

import pytest

from agv_motion.arbitration import Arbiter, TwistSource, sentence
from agv_motion.planar import Twist

S = TwistSource
A = Twist(0.1, 0.0, 0.2)
CASES = {
    'nobody drives: no source speaks': lambda a: None,
    'manual drives; page and agent wait: manual comes first': lambda a: say(
        a, S.AGENT, S.MANUAL, S.PAGE
    ),
    'agent drives': lambda a: say(a, S.AGENT),
    'manual drives; page, route and agent wait: manual is locked until released': lambda a: (
        a.lock(S.MANUAL), say(a, S.MANUAL, S.PAGE, S.ROUTE, S.AGENT)
    ),
    'page is locked and silent: standing; ~/lock_page with data: false releases it; agent waits: '
    'page is locked until released': lambda a: (a.lock(S.PAGE), say(a, S.AGENT)),
    'manual fell silent while it drove: standing until it speaks; ~/lock_manual with data: false '
    'releases it; agent waits: manual was let go': lambda a: (
        say(a, S.MANUAL), a.forget(), say(a, S.AGENT)
    ),
    'STOP: somebody fell, since 2015-06-15 11:00:00; release it by ~/stop with data: false; '
    'agent waits: STOP holds until released': lambda a: (
        a.stop('somebody fell', 1434366000.0), say(a, S.AGENT)
    ),
    'STOP: somebody fell, since 10000000000000000000000 s; release it by ~/stop with data: '
    'false': lambda a: a.stop('somebody fell', 1e22),
}  # fmt: skip


def say(arbiter, *sources):
    for source in sources:
        arbiter.receive(source, A, 0.0)


@pytest.mark.parametrize('text', CASES)
def test_who_drives_and_why_the_others_do_not(text):
    arbiter = Arbiter(dict.fromkeys(TwistSource, 1.0))
    CASES[text](arbiter)
    assert sentence(arbiter.choose(0.5)) == text
