# SPDX-License-Identifier: Apache-2.0
"""Lenses: where the ray of a point meets the image plane of a camera with focal length 1, and the way back.

Points are in the optical frame: x to the right, y down, z forward. Each lens has the parameters and the formulas of the
program that calibrates it; the formulas are written with NumPy, so that they work without OpenCV and for points behind
the image plane of a wide lens. A point that the lens cannot see is projected to NaN.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = [
    "DoubleSphereLens",
    "EnhancedUnifiedLens",
    "EquidistantLens",
    "FieldOfViewLens",
    "Lens",
    "OmnidirectionalLens",
    "PolynomialLens",
]

_TABLE_SIZE = 4096  # entries from which Newton's method starts
_NEWTON_STEPS = 8
_DERIVATIVE_STEP = 1e-6
_MAX_RESIDUAL = 1e-8  # of a focal length
_MAX_RADIUS = 1e6
_MIN_IMAGINARY = 1e-9  # of a root: below it, the root is real
_POLYNOMIAL_SIZE = 14


class Lens(Protocol):
    """A lens."""

    @property
    def name(self) -> str:
        """The name of its model, as in ``CameraInfo.distortion_model``."""
        ...

    @property
    def coefficients(self) -> tuple[float, ...]:
        """Its parameters, in the order of ``CameraInfo.d``."""
        ...

    def distort(self, points: Array) -> Array:
        """Return where the rays of points (N, 3) meet the image plane, (N, 2), NaN where the lens sees none."""
        ...

    def rays(self, places: Array) -> Array:
        """Return the unit vectors (N, 3) to places (N, 2) of the image plane, NaN where the lens draws nothing."""
        ...


class _BaseLens:
    """The parts that all lenses have."""

    name = ""

    def __init__(self, coefficients: Sequence[float] = ()) -> None:
        self.coefficients = tuple(float(value) for value in coefficients)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({list(self.coefficients)})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self.coefficients == getattr(other, "coefficients", None)

    def __hash__(self) -> int:
        return hash((self.name, self.coefficients))


class PolynomialLens(_BaseLens):
    """OpenCV's model: k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty; the last ones may be missing."""

    @property
    def name(self) -> str:  # type: ignore[override]
        """The name of the model by the number of coefficients."""
        return "plumb_bob" if not any(self.coefficients[5:]) else "rational_polynomial"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        with np.errstate(all="ignore"):
            normalized_points = points[:, :2] / points[:, 2:]
            seen = (points[:, 2] > 0.0) & (
                np.hypot(normalized_points[:, 0], normalized_points[:, 1]) <= self.max_radius
            )
            normalized_points[~seen] = np.nan
            return self.distort_flat(normalized_points)

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        normalized_points = self.undistort_flat(places)
        return _unit_vectors(np.concatenate([normalized_points, np.ones((len(normalized_points), 1))], axis=1))

    def distort_flat(self, normalized_points: Array) -> Array:
        """Move places of an undistorted image plane (N, 2) as the lens does."""
        _, _, p1, p2, _, _, _, _, s1, s2, s3, s4, tilt_x, tilt_y = self._padded
        x, y = normalized_points.T
        square = x * x + y * y
        radial = self._radial(square)
        distorted = np.stack(
            [
                x * radial + 2 * p1 * x * y + p2 * (square + 2 * x * x) + s1 * square + s2 * square**2,
                y * radial + p1 * (square + 2 * y * y) + 2 * p2 * x * y + s3 * square + s4 * square**2,
            ],
            axis=1,
        )
        return _by_homography(self._tilt, distorted) if tilt_x or tilt_y else distorted

    def undistort_flat(self, places: Array) -> Array:
        """Return the places of the undistorted image plane, NaN where there is none."""
        if not any(self.coefficients):
            return np.array(places)
        with np.errstate(all="ignore"):
            level = _by_homography(np.asarray(np.linalg.inv(self._tilt), np.float64), places)
            radius = np.hypot(level[:, 0], level[:, 1])
            # The radial part alone grows with the radius, so it can be inverted; the rest is small.
            start = _inverse_of_table(lambda r: r * self._radial(r * r), radius, self.max_radius)
            normalized_points = level * np.where(radius > 0.0, start / radius, 1.0)[:, None]
            for _ in range(_NEWTON_STEPS):
                normalized_points = normalized_points + self._newton_step(normalized_points, places)
            errors = np.abs(self.distort_flat(normalized_points) - places).max(axis=1)
            outside = np.hypot(normalized_points[:, 0], normalized_points[:, 1]) > self.max_radius * (1.0 + 1e-9)
            normalized_points[outside | ~(errors < _MAX_RESIDUAL * (1.0 + radius))] = np.nan
            return normalized_points

    def _newton_step(self, normalized_points: Array, places: Array) -> Array:
        step = _DERIVATIVE_STEP * np.maximum(1.0, np.abs(normalized_points).max(axis=1))
        columns = []
        for axis in np.eye(2):
            later, earlier = (
                self.distort_flat(normalized_points + sign * step[:, None] * axis) for sign in (1.0, -1.0)
            )
            columns.append((later - earlier) / (2.0 * step[:, None]))
        (a, c), (b, d) = columns[0].T, columns[1].T
        u, v = (places - self.distort_flat(normalized_points)).T
        determinant = a * d - b * c
        return np.asarray(np.stack([d * u - b * v, a * v - c * u], axis=1) / determinant[:, None])

    @cached_property
    def max_radius(self) -> float:
        """The distance from the axis at which the polynomial turns back, so that the lens sees nothing beyond it."""
        k1, k2, _, _, k3, k4, k5, k6, *_ = self._padded
        above, below = np.polynomial.Polynomial([1.0, k1, k2, k3]), np.polynomial.Polynomial([1.0, k4, k5, k6])
        square = np.polynomial.Polynomial([0.0, 1.0])
        slope = above * below + 2.0 * square * (above.deriv() * below - above * below.deriv())
        return float(np.sqrt(min(_first_root(slope), _first_root(below))))

    def _radial(self, square: Array) -> Array:
        k1, k2, _, _, k3, k4, k5, k6, *_ = self._padded
        above = 1.0 + square * (k1 + square * (k2 + square * k3))
        return np.asarray(above / (1.0 + square * (k4 + square * (k5 + square * k6))))

    @cached_property
    def _padded(self) -> tuple[float, ...]:
        return self.coefficients + (0.0,) * (_POLYNOMIAL_SIZE - len(self.coefficients))

    @cached_property
    def _tilt(self) -> Array:
        """The homography of a tilted sensor (Scheimpflug), (3, 3)."""
        (sin_x, sin_y), (cos_x, cos_y) = np.sin(self._padded[12:]), np.cos(self._padded[12:])
        about_x = np.array([[1.0, 0.0, 0.0], [0.0, cos_x, sin_x], [0.0, -sin_x, cos_x]])
        about_y = np.array([[cos_y, 0.0, -sin_y], [0.0, 1.0, 0.0], [sin_y, 0.0, cos_y]])
        rotation = about_y @ about_x
        along = np.array(
            [[rotation[2, 2], 0.0, -rotation[0, 2]], [0.0, rotation[2, 2], -rotation[1, 2]], [0.0, 0.0, 1.0]]
        )
        return np.asarray(along @ rotation)


class EquidistantLens(_BaseLens):
    """The fisheye of Kannala and Brandt, as in OpenCV: k1, k2, k3, k4. The angle to the axis gives the radius."""

    name = "equidistant"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        radius = np.hypot(points[:, 0], points[:, 1])
        angle = np.arctan2(radius, points[:, 2])
        angle[angle > self.max_angle] = np.nan
        with np.errstate(all="ignore"):
            # On the axis, the angle is the radius at a distance of 1.
            scale = np.where(radius > 0.0, self._radius(angle) / radius, 1.0)
        places = points[:, :2] * scale[:, None]
        on_axis = radius == 0.0
        places[on_axis & (points[:, 2] > 0.0)] = 0.0
        places[on_axis & ~(points[:, 2] > 0.0)] = np.nan
        return np.asarray(places)

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        radius = np.hypot(places[:, 0], places[:, 1])
        with np.errstate(all="ignore"):
            angle = _inverse_of_table(self._radius, radius, self.max_angle)
            for _ in range(_NEWTON_STEPS):
                angle = angle - (self._radius(angle) - radius) / self._slope(angle)
            angle[~(angle <= self.max_angle * (1.0 + 1e-12))] = np.nan
            normalized_points = places * np.where(radius > 0.0, np.sin(angle) / radius, 1.0)[:, None]
        return np.concatenate([normalized_points, np.cos(angle)[:, None]], axis=1)

    @cached_property
    def max_angle(self) -> float:
        """The angle to the axis in radians at which the polynomial turns back; at most half a turn."""
        k1, k2, k3, k4 = self._padded
        slope = np.polynomial.Polynomial([1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3, 9.0 * k4])
        return float(min(np.sqrt(_first_root(slope)), np.pi))

    @cached_property
    def _padded(self) -> tuple[float, ...]:
        return self.coefficients + (0.0,) * (4 - len(self.coefficients))

    def _radius(self, angle: Array) -> Array:
        k1, k2, k3, k4 = self._padded
        square = angle * angle
        return np.asarray(angle * (1.0 + square * (k1 + square * (k2 + square * (k3 + square * k4)))))

    def _slope(self, angle: Array) -> Array:
        k1, k2, k3, k4 = self._padded
        square = angle * angle
        return np.asarray(1.0 + square * (3 * k1 + square * (5 * k2 + square * (7 * k3 + square * 9 * k4))))


class DoubleSphereLens(_BaseLens):
    """The double sphere model of Usenko, Demmel and Cremers (2018): xi, alpha."""

    name = "double_sphere"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        xi, alpha = self.coefficients
        x, y, z = points.T
        first = np.sqrt(x * x + y * y + z * z)
        shifted = xi * first + z
        second = np.sqrt(x * x + y * y + shifted * shifted)
        w1 = alpha / (1.0 - alpha) if alpha <= 0.5 else (1.0 - alpha) / alpha
        w2 = (w1 + xi) / np.sqrt(2.0 * w1 * xi + xi * xi + 1.0)
        return _divide(points, alpha * second + (1.0 - alpha) * shifted, z > -w2 * first)

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        xi, alpha = self.coefficients
        square = np.sum(places * places, axis=1)
        with np.errstate(invalid="ignore"):
            root = np.sqrt(1.0 - (2.0 * alpha - 1.0) * square)
            z = (1.0 - alpha * alpha * square) / (alpha * root + 1.0 - alpha)
            factor = (z * xi + np.sqrt(z * z + (1.0 - xi * xi) * square)) / (z * z + square)
        return np.stack([factor * places[:, 0], factor * places[:, 1], factor * z - xi], axis=1)


class EnhancedUnifiedLens(_BaseLens):
    """The enhanced unified camera model of Khomutenko, Garcia and Martinet (2016): alpha, beta."""

    name = "eucm"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        alpha, beta = self.coefficients
        x, y, z = points.T
        length = np.sqrt(beta * (x * x + y * y) + z * z)
        w = alpha / (1.0 - alpha) if alpha <= 0.5 else (1.0 - alpha) / alpha
        return _divide(points, alpha * length + (1.0 - alpha) * z, z > -w * length)

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        alpha, beta = self.coefficients
        square = np.sum(places * places, axis=1)
        with np.errstate(invalid="ignore"):
            root = np.sqrt(1.0 - (2.0 * alpha - 1.0) * beta * square)
            z = (1.0 - beta * alpha * alpha * square) / (alpha * root + 1.0 - alpha)
        return _unit_vectors(np.concatenate([places, z[:, None]], axis=1))


class OmnidirectionalLens(_BaseLens):
    """The unified model of Mei and Rives (2007) with a polynomial behind the mirror: xi, k1, k2, p1, p2."""

    name = "omni"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        xi, *polynomial = self.coefficients
        length = np.linalg.norm(points, axis=1)
        lowest = xi if xi <= 1.0 else 1.0 / xi
        normalized_points = _divide(points, points[:, 2] + xi * length, points[:, 2] > -lowest * length)
        return PolynomialLens(polynomial).distort_flat(normalized_points)

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        xi, *polynomial = self.coefficients
        normalized_points = PolynomialLens(polynomial).undistort_flat(places)
        square = np.sum(normalized_points * normalized_points, axis=1)
        with np.errstate(invalid="ignore"):
            z = 1.0 - xi * (square + 1.0) / (xi + np.sqrt(1.0 + (1.0 - xi * xi) * square))
        return _unit_vectors(np.concatenate([normalized_points, z[:, None]], axis=1))


class FieldOfViewLens(_BaseLens):
    """The field-of-view model of Devernay and Faugeras (2001): w, an angle in radians."""

    name = "fov"

    def distort(self, points: Array) -> Array:
        """Return the places of points in the image plane."""
        (w,) = self.coefficients
        with np.errstate(all="ignore"):
            normalized_points = points[:, :2] / points[:, 2:]
            normalized_points[~(points[:, 2] > 0.0)] = np.nan
            radius = np.hypot(normalized_points[:, 0], normalized_points[:, 1])
            scale = np.arctan(2.0 * radius * np.tan(w / 2.0)) / (w * radius) if w else np.ones(len(normalized_points))
            return np.asarray(
                normalized_points * np.where(radius > 0.0, scale, 2.0 * np.tan(w / 2.0) / w if w else 1.0)[:, None]
            )

    def rays(self, places: Array) -> Array:
        """Return the unit vectors to places of the image plane."""
        (w,) = self.coefficients
        radius = np.hypot(places[:, 0], places[:, 1])
        with np.errstate(all="ignore"):
            scale = np.tan(radius * w) / (2.0 * radius * np.tan(w / 2.0)) if w else np.ones(len(places))
            normalized_points = (
                places * np.where(radius > 0.0, scale, w / (2.0 * np.tan(w / 2.0)) if w else 1.0)[:, None]
            )
        normalized_points[radius * abs(w) >= np.pi / 2.0] = np.nan
        return _unit_vectors(np.concatenate([normalized_points, np.ones((len(normalized_points), 1))], axis=1))


def _divide(points: Array, by: Array, seen: NDArray[np.bool_]) -> Array:
    with np.errstate(all="ignore"):
        places = points[:, :2] / by[:, None]
    places[~(seen & (by > 0.0))] = np.nan
    return np.asarray(places)


def _unit_vectors(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def _by_homography(matrix: Array, places: Array) -> Array:
    projected = places @ matrix[:, :2].T + matrix[:, 2]
    return np.asarray(projected[:, :2] / projected[:, 2:])


def _first_root(polynomial: np.polynomial.Polynomial) -> float:
    """Return the smallest positive real root, or infinity."""
    roots = np.asarray(polynomial.trim(1e-300).roots(), np.complex128)
    real = roots.real[np.abs(roots.imag) < _MIN_IMAGINARY * np.maximum(1.0, np.abs(roots))]
    return float(real[real > 0.0].min(initial=np.inf))


def _inverse_of_table(function: Callable[[Array], Array], values: Array, end: float) -> Array:
    """Return where an increasing function has some values, by a table up to `end`; NaN beyond it."""
    largest = np.nanmax(values, initial=0.0)
    if end > _MAX_RADIUS:
        end = 1.0
        while end < _MAX_RADIUS and function(np.array([end]))[0] < largest:
            end *= 2.0
    table = np.linspace(0.0, end, _TABLE_SIZE)
    found = np.interp(values, function(table), table)
    found[values > function(np.array([end]))[0] * (1.0 + 1e-9)] = np.nan
    return np.asarray(found)
