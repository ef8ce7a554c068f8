"""Parameters by the names that tools have for them: read, set, watched."""

from __future__ import annotations

from agv_motion.dashboard.foxglove.protocol import NO_GRAPH


def test_parameters_are_read_and_what_is_not_there_is_told(tool):
    tool.ask('getParameters', parameterNames=[], id='all')
    told = tool.wait('parameterValues')
    assert told['id'] == 'all'
    values = {row['name']: row.get('value') for row in told['parameters']}
    assert values['/oak/motion_generator.rate'] == 10.0
    tool.ask('getParameters', parameterNames=['/oak/motion_generator.rate', '/oak/arbiter.x'])
    told = tool.wait('parameterValues')
    assert told == {
        'op': 'parameterValues',
        'parameters': [{'name': '/oak/motion_generator.rate', 'value': 10.0, 'type': 'float64'}],
    }  # fmt: skip
    assert "no parameter '/oak/arbiter.x'" in tool.refusal()


def test_parameters_are_set_and_read_back(tool, robots):
    rows = [{'name': '/oak/arbiter.rate', 'value': 25, 'type': 'float64'},
            {'name': '/oak/arbiter.stamped', 'value': False}]  # fmt: skip
    tool.ask('setParameters', parameters=rows, id='q')
    assert tool.wait('parameterValues')['id'] == 'q'
    assert robots.asked[-1] == (
        'oak', 'set_parameters', {'node': 'arbiter', 'values': {'rate': 25.0, 'stamped': False}}
    )  # fmt: skip
    tool.ask('setParameters', parameters=[{'name': '/elm/arbiter.rate', 'value': 2}])
    assert "no robot has a node '/elm/arbiter'" in tool.refusal()


def test_changes_are_told_to_who_wants_them(tool, graph):
    tool.ask('subscribeParameterUpdates', parameterNames=['/oak/arbiter.rate'])
    tool.ask('fetchAsset', uri='x', requestId=1)
    tool.wait('asset')
    assert graph.watched == (True, False)
    graph.change(**{'/oak/arbiter.rate': 7, '/oak/arbiter.other': 8})
    assert tool.wait('parameterValues')['parameters'] == [{'name': '/oak/arbiter.rate', 'value': 7}]
    tool.ask('unsubscribeParameterUpdates', parameterNames=[])
    tool.ask('fetchAsset', uri='x', requestId=2)
    tool.wait('asset')
    assert graph.watched == (False, False)
    assert graph.connections is NO_GRAPH
