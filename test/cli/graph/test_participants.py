"""The ports in the kernel's table tell how many participants there are."""

from __future__ import annotations

import pytest

from agv_motion.cli.graph import participants

HEAD = '   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt\n'


def _table(*ports):
    return HEAD + ''.join(
        f' {i}: 0100007F:{port:04X} 00000000:0000 07 00000000:00000000\n'
        for i, port in enumerate(ports)
    )


@pytest.mark.parametrize(
    ('domain', 'ports', 'count'),
    [
        (0, (7400, 7410, 7411), 1),
        (0, (7400, 7410, 7411, 7412, 7413, 7410), 2),
        (0, (7411, 7413, 53, 40000), 0),
        (0, (7660,), 0),
        (1, (7410, 7660, 7661, 7898), 2),
        (101, (7400 + 250 * 101 + 10 + 2 * 7,), 1),
    ],
)
def test_participants_of_a_domain_are_counted_by_their_ports(
    tmp_path, monkeypatch, domain, ports, count
):
    table = tmp_path / 'udp'
    table.write_text(_table(*ports))
    monkeypatch.setattr(participants, 'TABLES', (str(table), str(tmp_path / 'no table')))
    assert participants.on_this_machine(domain) == count


def test_a_node_alone_has_heard_itself(graph):
    node = graph.node('listener')
    graph.spin_until(lambda: participants.heard(participants.ends_of(node)) >= 1)
    assert participants.on_this_machine(graph.context.get_domain_id()) >= 1
    graph.spin_until(lambda: participants.missing(node) == 0)
