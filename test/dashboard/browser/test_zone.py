"""The zone that is edited is that of the robot that is chosen, and goes to no other."""

from __future__ import annotations

import json

SQUARE = {'boundary': [[0, 0], [9, 0], [9, 9], [0, 9]], 'holes': [], 'translation_only': [],
          'margin': 0.5, 'clearance_from': 'rim', 'home': [2, 2]}  # fmt: skip
YARD = SQUARE | {'boundary': [[0, 0], [30, 0], [30, 20]]}


def test_the_zone_of_one_robot_is_never_put_in_force_for_another(
    make_park, serve, open_page, wait_until
):
    park = make_park('oak', 'ash')
    park.tell_all()
    park.say('oak', 'zone', SQUARE)
    park.say('ash', 'zone', YARD)
    page = open_page(serve(park).url)
    page.wait_for_selector('[data-act=drive]')
    page.click('[data-drawer=zone]')
    page.click('#zone-edit')
    page.wait_for_selector('#zone-send')
    page.select_option('.drawer select', 'ash')
    page.wait_for_selector('#zone-send', state='detached')
    page.click('#zone-edit')
    page.click('#zone-send')
    wait_until(lambda: any('zone' in json.dumps(asked) for asked in park.asked), 20.0)
    robot, _, arguments = next(asked for asked in park.asked if 'zone' in json.dumps(asked))
    assert robot == 'ash'
    assert '[30.0, 20.0]' in json.dumps(arguments)
