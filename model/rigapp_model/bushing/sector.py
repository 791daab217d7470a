"""One sector of the ring, condensed to its inner surface for each harmonic.

All sectors have the same stiffness, so the ring's stiffness matrix is block circulant: a discrete
Fourier transform splits it into one small system per harmonic. In polar components, with the
tangential ones shifted by a quarter wave, these systems are real, because a sector is its own
mirror image. Each is condensed layer by layer from the fixed rim to the inner surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rigapp_model.bushing.element import Plane, elasticity, integration_points, stiffness
from rigapp_model.compiled import njit
from rigapp_model.errors import ModelError

Array = NDArray[np.float64]

MOST_LAYERS = 24  # more change the surface's compliance by less than the sectors do
SQUARE = 1.5  # aspect ratio of the innermost elements; with a larger one their pressure is wrong
STEEPEST = 2.5  # ratio of thickness of adjacent layers; with a larger one elements are too unequal
# First of the layer's ten condensed degrees of freedom of each node of its element:
# outer line 0-1, outer mid 2-3, radial mid 4-5, inner line 6-7, inner mid 8-9.
_FOLD = np.array([6, 0, 0, 6, 4, 2, 4, 8])
# Angle of each node of the element in half sectors.
_TURN = np.array([0, 0, 2, 2, 0, 1, 2, 1])


@dataclass(frozen=True, slots=True)
class SectorMesh:
    """Mesh of the ring: equal sectors of graded layers of 8-node quadrilaterals.

    ``sectors``: their number, with two surface nodes each; ``layers``: elements from the inner
    surface to the rim; ``grading``: thickness of the outermost layer over the innermost.
    """

    sectors: int = 180
    layers: int = 8
    grading: float = 10.0

    def __post_init__(self) -> None:
        if self.sectors < 8:
            raise ModelError("sectors", self.sectors, "give at least 8 of them")
        if self.layers < 1:
            raise ModelError("layers", self.layers, "give at least 1 of them")
        if not self.grading >= 1.0:
            raise ModelError("grading", self.grading, "give at least 1")

    def radii(self, inner: float, outer: float) -> Array:
        """Return the radii between the layers from the inner surface to the rim, m."""
        if not 0.0 < inner < outer:
            raise ModelError("bushing_radius", inner, f"it must be between 0 and {outer:g} m", "m")
        ratio = self.grading ** (1.0 / max(self.layers - 1, 1))
        steps = ratio ** np.arange(self.layers)
        return inner + (outer - inner) * np.concatenate(([0.0], np.cumsum(steps) / steps.sum()))


def suitable_mesh(sectors: int, inner: float, outer: float) -> SectorMesh:
    """Return a mesh with this number of sectors and about square innermost elements."""
    square = 2.0 * np.pi * inner / sectors
    layers, thickness = 8, outer - inner
    while layers < MOST_LAYERS:
        for grading in (10.0, 100.0, 1000.0, 1e4):
            mesh = SectorMesh(sectors, layers, grading)
            ratio = grading ** (1.0 / (layers - 1))
            first = thickness * (ratio - 1.0) / (ratio**layers - 1.0)
            if first <= SQUARE * square and ratio < STEEPEST:
                return mesh
        layers += 2
    return SectorMesh(sectors, MOST_LAYERS, 1e4)


@lru_cache(maxsize=8)
def surface_spectrum(
    inner: float,
    outer: float,
    youngs_modulus: float,
    poissons_ratio: float,
    plane: Plane = "strain",
    mesh: SectorMesh | None = None,
) -> Array:
    """Compute the compliance kernel of the inner surface, shape (2, 2, 2, 2, sectors), m^2/N.

    Entry [i, a, j, b, k]: displacement component a (0 radial, 1 tangential) of surface node i
    (0 on the sector's line, 1 in its middle), k sectors after a unit force per width along b at
    node j. The rim is fixed. Raises ModelError for impossible radii or materials.
    """
    mesh = mesh or SectorMesh()
    n = mesh.sectors
    matrix = elasticity(youngs_modulus, poissons_ratio, plane)
    points = integration_points(poissons_ratio, plane)
    layers = _polar_layers(mesh.radii(inner, outer), matrix, mesh.sectors, points)
    condensed = _condense(layers, n, n // 2 + 1)
    harmonic = np.arange(n // 2 + 1)
    quarter = np.array([1.0, 1j])
    middle = np.exp(1j * np.pi * harmonic / n)
    phase = np.concatenate(
        [np.broadcast_to(quarter, (harmonic.size, 2)), middle[:, None] * quarter], axis=1
    )
    spectrum = phase[:, :, None] * condensed * phase[:, None, :].conj()
    kernel = np.ascontiguousarray(np.moveaxis(np.fft.irfft(spectrum, n, axis=0), 0, -1))
    kernel.flags.writeable = False
    return kernel.reshape(2, 2, 2, 2, n)


def _polar_layers(radii: Array, matrix: Array, sectors: int, points: int) -> Array:
    """Return each layer's element stiffness in polar components, shape (layers, 16, 16)."""
    low, high = radii[:-1], radii[1:]
    middle = 0.5 * (low + high)
    radius = np.stack([low, high, high, low, middle, high, middle, low], axis=1)
    angle = _TURN * (np.pi / sectors)
    cosine, sine = np.cos(angle), np.sin(angle)
    nodes = np.stack([radius * cosine, radius * sine], axis=2)
    turn = np.zeros((16, 16))
    even = np.arange(0, 16, 2)
    turn[even, even] = turn[even + 1, even + 1] = cosine
    turn[even, even + 1], turn[even + 1, even] = -sine, sine
    return np.ascontiguousarray(turn.T @ stiffness(nodes, matrix, points) @ turn)


_FOLD_DOFS = np.ascontiguousarray((_FOLD[:, None] + np.arange(2)).ravel())
_TURN_DOFS = np.ascontiguousarray(np.repeat(_TURN, 2))


@njit("float64[:,:,::1](float64[:,:,::1], int64, int64)", cache=True)
def _condense(layers, sectors, harmonics):  # type: ignore[no-untyped-def]
    """Return the surface compliance of each harmonic, shape (harmonics, 4, 4), real."""
    result = np.empty((harmonics, 4, 4))
    system = np.empty((10, 10))
    for m in range(harmonics):
        wave = np.pi * m / sectors
        cosines = np.array([np.cos(wave * t) for t in range(-2, 3)])
        sines = np.array([np.sin(wave * t) for t in range(-2, 3)])
        for layer in range(layers.shape[0] - 1, -1, -1):
            rim = layer == layers.shape[0] - 1
            carried = system[6:, 6:].copy()
            system[:] = 0.0
            if not rim:
                system[:4, :4] = carried
            for p in range(16):
                for q in range(16):
                    turn = _TURN_DOFS[q] - _TURN_DOFS[p] + 2
                    if p % 2 == q % 2:
                        factor = cosines[turn]
                    elif p % 2 == 0:
                        factor = -sines[turn]
                    else:
                        factor = sines[turn]
                    system[_FOLD_DOFS[p], _FOLD_DOFS[q]] += factor * layers[layer, p, q]
            for pivot in range(4 if rim else 0, 6):
                for i in range(pivot + 1, 10):
                    ratio = system[i, pivot] / system[pivot, pivot]
                    for j in range(pivot + 1, 10):
                        system[i, j] -= ratio * system[pivot, j]
        result[m] = np.linalg.inv(np.ascontiguousarray(system[6:, 6:]))
    return result
