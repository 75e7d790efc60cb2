"""Strain energy per volume of the elements of solids."""
from __future__ import annotations

import itertools
from typing import Any, Iterator, Mapping, Sequence, Tuple

import numpy as np

BOUNDARIES = {3: (0, 1, 2), 4: (0, 1, 2, 3), 6: (0, 3, 1, 4, 2, 5), 8: (0, 4, 1, 5, 2, 6, 3, 7)}


class Solid:
    """A mesh: nodes (m, k) of indices, of each element in turn; boundaries (m, k), the same counterclockwise. names
    (m,): of its elements, as quantities have them."""

    def __init__(self, solid: Mapping[str, Any], materials: Sequence[Mapping[str, Any]], index: Mapping[str, int],
                 names: Iterator[str]) -> None:
        """names: of its elements, and of those of the solids after it."""
        count = solid['nodes_per_element']
        self.nodes = np.array([index[name] for name in solid['nodes']], dtype=int).reshape(-1, count)
        self.names = list(itertools.islice(names, len(self.nodes)))
        self.boundaries = self.nodes[:, BOUNDARIES[count]]
        self.material = next(material for material in materials if material['name'] == solid['material'])
        self.plane = solid['plane']

    def energies(self, initial: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Of each element [force/length^2]; initial, places: (n, 2) of all nodes."""
        weights, gradients = cell_points(self.nodes.shape[1])
        before, after = (np.einsum('mna,knb->mkab', at[self.nodes], gradients) for at in (initial, places))
        areas = weights * np.linalg.det(before)
        energies = energy(self.material, self.plane, (after @ np.linalg.inv(before)).reshape(-1, 2, 2))
        return (areas * energies.reshape(areas.shape)).sum(axis=1) / areas.sum(axis=1)


def cell_points(count: int) -> Tuple[np.ndarray, np.ndarray]:
    """Of the cell with so many nodes: weights (k,) of the integration points, and gradients (k, count, 2) there of the shape
    functions, by the coordinates of the cell."""
    if count in (3, 6):
        places = np.array([[1, 1], [4, 1], [1, 4]]) / 6.0 if count == 6 else np.array([[1, 1]]) / 3.0
        areas = np.column_stack((1.0 - places.sum(axis=1), places))[:, :, None]  # area coordinates and their gradients
        flat = np.broadcast_to([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]], (len(places), 3, 2))
        gradients = flat
        if count == 6:
            following = [1, 2, 0]
            sides = 4.0 * (areas[:, following] * flat + areas * flat[:, following])
            gradients = np.concatenate(((4.0 * areas - 1.0) * flat, sides), axis=1)
        return np.full(len(places), 0.5 / len(places)), gradients
    a, b = np.array([[-1.0, 1.0, 1.0, -1.0], [-1.0, -1.0, 1.0, 1.0]])  # of the corners
    xi, eta = a[:, None] / np.sqrt(3.0), b[:, None] / np.sqrt(3.0)
    if count == 4:
        corners = np.stack((a * (1.0 + b * eta), b * (1.0 + a * xi)), axis=2)
        return np.ones(4), 0.25 * corners
    corners = np.stack((a * (1.0 + b * eta) * (2.0 * a * xi + b * eta),
                        b * (1.0 + a * xi) * (a * xi + 2.0 * b * eta)), axis=2)
    sides = np.stack((np.hstack((-xi * (1.0 - eta), 0.5 * (1.0 - eta ** 2), -xi * (1.0 + eta), -0.5 * (1.0 - eta ** 2))),
                      np.hstack((-0.5 * (1.0 - xi ** 2), -eta * (1.0 + xi), 0.5 * (1.0 - xi ** 2), -eta * (1.0 - xi)))),
                     axis=2)
    return np.ones(4), np.concatenate((0.25 * corners, sides), axis=1)


def lame(material: Mapping[str, Any]) -> Tuple[float, float]:
    if not material['E']:
        return material['lambda'], material['mu']
    mu = material['E'] / (2.0 * (1.0 + material['nu']))
    return 2.0 * mu * material['nu'] / (1.0 - 2.0 * material['nu']), mu


def energy(material: Mapping[str, Any], plane: str, gradients: np.ndarray) -> np.ndarray:
    """W by F (m, 2, 2). Invariants of C in the plane: trace i, J^2; C33 is that of the plane state."""
    lam, mu = lame(material)
    model = material['model']
    stress = plane == 'stress'
    flat = 2.0 * lam * mu / (lam + 2.0 * mu) if stress else lam
    if model == 'linear':
        strain = 0.5 * (gradients + gradients.transpose(0, 2, 1)) - np.eye(2)
        return 0.5 * flat * np.trace(strain, axis1=1, axis2=2) ** 2 + mu * (strain ** 2).sum(axis=(1, 2))
    right = gradients.transpose(0, 2, 1) @ gradients
    if model == 'st_venant_kirchhoff':
        strain = 0.5 * (right - np.eye(2))
        return 0.5 * flat * np.trace(strain, axis1=1, axis2=2) ** 2 + mu * (strain ** 2).sum(axis=(1, 2))
    trace = np.trace(right, axis1=1, axis2=2)
    area = np.linalg.det(gradients) ** 2
    across = np.ones_like(trace)
    if model == 'neo_hookean':
        if stress:  # mu (C33 - 1) + lambda/2 ln(J^2 C33) = 0
            logarithm = np.maximum(0.0, -np.log(area))
            for _ in range(100):
                slope = mu * np.exp(logarithm) + 0.5 * lam
                logarithm -= (mu * np.expm1(logarithm) + 0.5 * lam * (np.log(area) + logarithm)) / slope
            across = np.exp(logarithm)
        volume = np.log(area * across)
        return 0.5 * mu * (trace + across - 3.0 - volume) + 0.125 * lam * volume ** 2
    a, b = material['a'], 0.5 * mu - material['a']
    d, e = 0.25 * lam - b, 0.5 * lam + mu
    if stress:
        across = 0.5 * e / (a + b * trace + d * area)
    return (a * (trace + across - 3.0) + b * (area + across * trace - 3.0) + d * (area * across - 1.0)
            - 0.5 * e * np.log(area * across))
