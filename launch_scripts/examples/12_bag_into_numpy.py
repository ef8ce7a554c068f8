"""Write a bag (MCAP, as rosbag2 does) and read one field of it straight into numpy; without ROS."""

import struct
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from agv_motion.bag import BagReader, BagWriter, read_topic

LITTLE_ENDIAN = b'\x00\x01\x00\x00'  # the header of CDR
DEFINITION = 'float64 x\nfloat64 y\nfloat64 z\n'

with TemporaryDirectory() as folder:
    path = Path(folder) / 'walk'
    with BagWriter(path) as bag:
        flow = bag.add_topic('/sap_flow', 'geometry_msgs/msg/Vector3', DEFINITION)
        for k in range(10_000):
            stamp = 1_434_369_600_000_000_000 + k * 100_000_000  # [ns] ten a second
            bag.write(flow, stamp, LITTLE_ENDIAN + struct.pack('<3d', k / 10_000, 0.5, 0.0))

    size = sum(file.stat().st_size for file in path.iterdir())
    print(sorted(file.name for file in path.iterdir()), f'{size / 1e6:.1f} MB')
    with BagReader(path) as bag:
        flow = read_topic(bag, '/sap_flow', ['x'])

s1, seconds = flow.fields['x'], flow.seconds()
print(f'{len(s1)} messages over {seconds[-1]:.1f} s; fields read: {list(flow.fields)}')
print(f'mean {s1.mean():.5f}, highest {s1.max():.4f} after {seconds[np.argmax(s1)]:.1f} s')
