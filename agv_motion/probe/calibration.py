"""Calibrations of the Granier probe: flux density ``F = a K**b`` for kinds of wood and species.

Granier's constants suit no tree exactly: measured against the weight of the water that went
through, species differ by a third to a half. Each row tells by how much F may be wrong, as the
standard deviation of ln F.

Sources: A. Granier 1985 for his own. The others are straight lines fitted here in ln K and ln F
(K above 0.02, F above 0) to the measurements that V. Flo et al., "A synthesis of bias and
uncertainty in sap flow methods", Agricultural and Forest Meteorology 271, 2019, collected from 22
studies, as published with the R package TREX (Peters et al. 2021). A species with several studies,
and a kind of wood, has the mean of their curves between K 0.1 and 0.4; its spread is that of the
measurements about their curve and that between curves at K 0.2, together. The spread of Granier's
own constants is the root mean square deviation of all woody species from them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from agv_motion.parameters import Spec, check
from agv_motion.probe.granier import COEFFICIENT, EXPONENT


class FluxCalibration(NamedTuple):
    """One curve ``F = coefficient * K**exponent``."""

    coefficient: float
    """[m/s]"""
    exponent: float
    spread: float
    """[-] standard deviation of ln F: a share, where it is small"""

    def flux_density(self, index: float) -> float:
        """Return the sap flux density [m/s] of Granier's K; 0 for negative K."""
        return self.coefficient * index**self.exponent if index > 0.0 else 0.0


CUSTOM = 'custom'

CALIBRATIONS = {
    'granier': FluxCalibration(COEFFICIENT, EXPONENT, 0.58),
    'coniferous': FluxCalibration(116.6e-6, 1.079, 0.40),
    'diffuse_porous': FluxCalibration(153.4e-6, 1.095, 0.53),
    'ring_porous': FluxCalibration(120.8e-6, 1.124, 0.39),
    'abies_concolor': FluxCalibration(138.9e-6, 0.915, 0.22),
    'acer_campestre': FluxCalibration(128.4e-6, 1.151, 0.62),
    'acer_pseudoplatanus': FluxCalibration(66.5e-6, 0.769, 0.17),
    'fagus_grandifolia': FluxCalibration(203.7e-6, 0.899, 0.30),
    'fagus_sylvatica': FluxCalibration(162.2e-6, 1.118, 0.18),
    'larix_decidua': FluxCalibration(169.5e-6, 1.223, 0.10),
    'liquidambar_styraciflua': FluxCalibration(116.0e-6, 1.147, 0.26),
    'malus_domestica': FluxCalibration(134.4e-6, 1.201, 0.40),
    'picea_abies': FluxCalibration(215.0e-6, 1.456, 0.13),
    'pinus_echinata': FluxCalibration(63.5e-6, 0.610, 0.18),
    'pinus_taeda': FluxCalibration(69.4e-6, 1.090, 0.32),
    'populus_deltoides': FluxCalibration(151.0e-6, 1.019, 0.20),
    'populus_nigra': FluxCalibration(174.5e-6, 1.144, 0.14),
    'prunus_persica': FluxCalibration(133.4e-6, 1.063, 0.18),
    'pseudotsuga_menziesii': FluxCalibration(112.5e-6, 1.181, 0.23),
    'quercus_alba': FluxCalibration(273.1e-6, 1.597, 0.37),
    'tilia_cordata': FluxCalibration(115.1e-6, 0.947, 0.20),
    'ulmus_americana': FluxCalibration(101.6e-6, 0.977, 0.28),
}


@dataclass(frozen=True)
class CalibrationParameters:
    """From K to flux density: a row of the table, or three numbers of one's own."""

    of: Annotated[
        str,
        Spec('kind of wood or species; custom: the three below', choices=(*CALIBRATIONS, CUSTOM)),
    ] = 'granier'
    coefficient: Annotated[float, Spec('a of F = a K**b', 'm/s', (1e-6, 1e-2))] = COEFFICIENT
    exponent: Annotated[float, Spec('b of F = a K**b', '1', (0.1, 5.0))] = EXPONENT
    spread: Annotated[float, Spec('standard deviation of ln F', '1', (0.0, 3.0))] = 0.58

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def chosen(self) -> FluxCalibration:
        """Return the curve that is meant."""
        custom = FluxCalibration(self.coefficient, self.exponent, self.spread)
        return CALIBRATIONS.get(self.of, custom)
