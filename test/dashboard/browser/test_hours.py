"""The hours in the drawer are those of the robot that is chosen, or none."""

from __future__ import annotations

ROW = {'unit': '', 'low': None, 'high': None, 'text': '', 'choices': [], 'dynamic': True}


def test_hours_of_one_robot_are_never_put_in_force_for_another(
    make_park, serve, open_page, wait_until
):
    park = make_park('oak', 'ash')
    park.tell_all()
    rows = [ROW | {'name': f'schedule.{name}', 'value': value, 'default': '08:00'}
            for name, value in (('opens', '09:30'), ('closes', '17:45'))]  # fmt: skip
    park.say('oak', 'parameters', {'nodes': [{'node': 'motion_generator', 'rows': rows}]})
    page = open_page(serve(park).url)
    page.wait_for_selector('[data-act=drive]')
    page.click('[data-drawer=zone]')
    opens, closes = page.locator('.hours [name=open]'), page.locator('.hours [name=close]')
    wait_until(lambda: opens.input_value() == '09:30', 20.0)
    assert closes.input_value() == '17:45'
    page.select_option('.drawer select', 'ash')
    wait_until(lambda: opens.input_value() != '09:30', 5.0)
    assert (opens.input_value(), closes.input_value()) == ('', '')
    page.click('.hours [type=submit]')
    assert page.evaluate("document.querySelector('.hours').checkValidity()") is False
    assert [asked for asked in park.asked if asked[1] != 'get_parameters'] == []
