"""Definitions of the installed types: the same as rosbags has, and findable without ROS."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from agv_motion.bag.cdr import definitions
from agv_motion.errors import ConfigurationError

STORE = get_typestore(Stores.ROS2_JAZZY)


def installed(message_type):
    try:
        return definitions.installed(message_type)
    except ConfigurationError:
        pytest.skip(f'{message_type} is not installed')


@pytest.mark.parametrize(
    'message_type',
    ['geometry_msgs/msg/TwistStamped', 'nav_msgs/msg/Path', 'std_msgs/msg/Float64MultiArray'],
)
def test_text_and_hash_are_those_of_the_distribution(message_type):
    definition = installed(message_type)
    for name, fields in get_types_from_msg(definition.text, message_type).items():
        assert fields == STORE.fielddefs[name]
    assert definition.hash == STORE.hash_rihs01(message_type)


def write(prefix, name, text, kind='msg'):
    path = prefix / 'share' / 'garden_msgs' / kind / f'{name}.{kind}'
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_used_types_follow_once_in_the_order_of_use(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    write(tmp_path, 'Tree', '# Oak beside\nuint8 OAK=1\nLeaf[<=3] leaves\ngarden_msgs/Root root\n')
    write(tmp_path, 'Leaf', 'string<=10 name "green" # Vein no\nVein[2] veins\n')
    write(tmp_path, 'Vein', 'float64 length\n')
    write(tmp_path, 'Root', '\n  Vein  vein\n')
    parts = definitions.installed('garden_msgs/msg/Tree').text.split(f'\n{definitions.SEPARATOR}\n')
    assert [part.split('\n')[0] for part in parts[1:]] == [
        f'MSG: garden_msgs/{name}' for name in ('Leaf', 'Vein', 'Root')
    ]
    assert parts[0].startswith('# Oak beside')


def test_a_file_is_told_as_it_is_and_of_a_service_what_is_asked(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    write(tmp_path, 'Bough', 'float64 length\n---')
    write(tmp_path, 'Cut', 'bool deep\n---\nbool done\n', 'srv')
    for name, text in (
        ('msg/Bough', 'float64 length\n---'), ('srv/Cut_Request', 'bool deep\n'),
        ('srv/Cut_Response', 'bool done\n'),
    ):  # fmt: skip
        assert definitions.installed(f'garden_msgs/{name}') == (text, '')


def test_a_type_whose_package_has_no_wheel_is_known():
    text, digest = definitions.installed('tf2_msgs/msg/TFMessage')
    assert text.startswith('geometry_msgs/TransformStamped[] transforms\n')
    assert digest == STORE.hash_rihs01('tf2_msgs/msg/TFMessage')


def test_a_type_that_uses_itself_ends(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    write(tmp_path, 'Loop', 'Loop[] loops\n')
    assert 'MSG' not in definitions.installed('garden_msgs/msg/Loop').text


@pytest.mark.parametrize('message_type', ['String', 'a/b/c/d', '../msg/passwd', 'std_msgs/idl/X'])
def test_a_malformed_name_is_refused(message_type):
    with pytest.raises(ConfigurationError, match='PACKAGE/msg/NAME'):
        definitions.installed(message_type)


def test_a_missing_type_is_named_with_the_places_searched(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    write(tmp_path, 'Stem', 'Missing part\n')
    with pytest.raises(ConfigurationError, match=r'garden_msgs/msg/Missing\.msg .*Stem.*') as error:
        definitions.installed('garden_msgs/msg/Stem')
    assert str(tmp_path) in str(error.value)
