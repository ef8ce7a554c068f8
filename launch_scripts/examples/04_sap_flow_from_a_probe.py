"""From the millivolts of a Granier probe to sap flow: a CSV of three days, a row each half hour.

The needles are farther apart in temperature the less sap flows. The highest reading before dawn is
zero flow, known after the first night; how much flow is 1, after a day.
"""

import csv
from datetime import datetime, timedelta
from io import StringIO
from math import pi, sin

from agv_motion.probe import read_series

KELVIN_PER_MILLIVOLT = 25.0
START = datetime.fromisoformat('2015-06-15T00:00:00+00:00')


def recording() -> StringIO:
    """Return a CSV file: 0.80 mV at night, 0.64 mV at noon."""
    rows = ['time,mV']
    for k in range(3 * 48):
        time = START + timedelta(hours=0.5 * k)
        sun = max(sin(pi * (time.hour + time.minute / 60.0 - 6.0) / 12.0), 0.0)
        rows.append(f'{time.isoformat()},{0.80 - 0.16 * sun:.4f}')
    return StringIO('\n'.join(rows))


rows = list(csv.DictReader(recording()))
times = [datetime.fromisoformat(row['time']) for row in rows]
series = read_series(
    [time.timestamp() for time in times], [KELVIN_PER_MILLIVOLT * float(row['mV']) for row in rows]
)
for i, time in enumerate(times):
    if time.hour in (0, 9, 12) and time.minute == 0:
        kelvin, flux = series.temperature_difference[i], 1e6 * series.flux_density[i]
        sap = series.sap_flow[i]  # NaN where it cannot be known: then the tree rests
        print(f'{time:%d %b %H:%M}  dT {kelvin:.1f} K  {flux:.1f} um/s  sap flow {sap:.2f}')
