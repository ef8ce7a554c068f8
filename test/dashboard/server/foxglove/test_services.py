"""Services come, are called, and go; what nobody may call is not told of."""

from __future__ import annotations

import struct


def call(tool, service, data, number=8, encoding=b'cdr'):
    tool.socket.send(struct.pack('<BIII', 2, service, number, len(encoding)) + encoding + data)


def test_services_come_are_called_and_go(tool, graph):
    assert tool.wait('advertiseServices')['services'] == []
    graph.services = {'/oak/arbiter/stop': 'std_srvs/srv/SetBool', '/oak/x': 'p/srv/Unknown',
                      '/oak/arbiter/set_parameters': 'std_srvs/srv/SetBool'}  # fmt: skip
    (service,) = tool.wait('advertiseServices')['services']
    assert service['name'] == '/oak/arbiter/stop'
    assert service['request']['schema'] == 'bool data'
    call(tool, service['id'], b'abc')
    told = tool.wait('response')['bytes']
    assert told == struct.pack('<III', service['id'], 8, 3) + b'cdr' + b'cba'
    assert graph.called == [('/oak/arbiter/stop', 'std_srvs/srv/SetBool', b'abc')]
    call(tool, service['id'], b'abc', encoding=b'json')
    assert "encoding 'json'" in tool.wait('serviceCallFailure')['message']
    graph.services = {}
    assert tool.wait('unadvertiseServices')['serviceIds'] == [service['id']]
    call(tool, service['id'], b'abc')
    assert 'no service' in tool.wait('serviceCallFailure')['message']
