# SPDX-License-Identifier: Apache-2.0
"""The lens that a name of a distortion model and its coefficients stand for, in the spellings that people publish."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe._output.formatting import join_names
from coframe.cameras.lenses import (
    DoubleSphereLens,
    EnhancedUnifiedLens,
    EquidistantLens,
    FieldOfViewLens,
    OmnidirectionalLens,
    PolynomialLens,
)
from coframe.errors import CameraError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.cameras.lenses import Lens

__all__ = ["LENS_NAMES", "canonical_name", "lens_of"]

_MAX_NAME = 60  # characters of a name in a message


class _Model(NamedTuple):
    """A model: its lens, the numbers of coefficients, their names, and other spellings of its name."""

    lens: Callable[[Sequence[float]], Lens]
    counts: tuple[int, ...]
    coefficients: str
    spellings: str
    zeros_by_default: bool = False


_POLYNOMIAL = "k1, k2, p1, p2[, k3[, k4, k5, k6[, s1, s2, s3, s4[, tx, ty]]]]"
# The names are compared without upper case and punctuation.
_MODELS: dict[str, _Model] = {
    "plumb_bob": _Model(
        PolynomialLens,
        (4, 5, 8, 12, 14),
        _POLYNOMIAL,
        "radtan radialtangential brownconrady brown opencv opencv5 standard pinholeradtan plumbbob5",
        zeros_by_default=True,
    ),
    "rational_polynomial": _Model(
        PolynomialLens,
        (4, 5, 8, 12, 14),
        _POLYNOMIAL,
        "rational rationalpolynomialmodel fullopencv opencv8 thinprism thinprismmodel rationalpolynomialthinprism "
        "tilted tiltedmodel tiltedthinprism opencvrational radtan8 rationalradtan",
        zeros_by_default=True,
    ),
    "equidistant": _Model(
        EquidistantLens,
        (4,),
        "k1, k2, k3, k4",
        "fisheye equi equidistance opencvfisheye kannalabrandt kannalabrandt4 kannalabrandt8 kb kb4 kb8 pinholeequi "
        "pinholeequidistant fisheyeopencv fisheyeequidistant",
        zeros_by_default=True,
    ),
    "double_sphere": _Model(DoubleSphereLens, (2,), "xi, alpha", "ds doublespherecamera dsnone"),
    "eucm": _Model(
        EnhancedUnifiedLens,
        (2,),
        "alpha, beta",
        "extendedunified enhancedunified extendedunifiedcameramodel enhancedunifiedcameramodel eucmnone",
    ),
    "omni": _Model(OmnidirectionalLens, (5,), "xi, k1, k2, p1, p2", "omniradtan mei omnidirectional"),
    "fov": _Model(FieldOfViewLens, (1,), "w", "fieldofview atan pinholefov fovcamera"),
}
LENS_NAMES = tuple(_MODELS)
"""The supported models, by the names that ``CameraInfo`` and Kalibr use."""
_SPELLINGS = {
    re.sub(r"[^a-z0-9]", "", spelling): name
    for name, model in _MODELS.items()
    for spelling in (name, *model.spellings.split())
}
# Names that mean "no distortion"; with coefficients that are not zero they are a contradiction.
_WITHOUT_DISTORTION = {"none", "nodistortion", "pinhole", "perspective", "ideal", "rectified", "undistorted", "null"}


def canonical_name(name: str) -> str | None:
    """Return the name under which a model is listed here, "" for a camera without distortion, None if unknown.

    Example:
        >>> canonical_name("Plumb Bob"), canonical_name("kannala_brandt4"), canonical_name("ftheta")
        ('plumb_bob', 'equidistant', None)
    """
    normalized = re.sub(r"[^a-z0-9]", "", name.lower())
    return "" if not normalized or normalized in _WITHOUT_DISTORTION else _SPELLINGS.get(normalized)


def lens_of(name: str, coefficients: Sequence[float] = ()) -> Lens:
    """Return the lens of a distortion model.

    An empty name means ``plumb_bob``. Without coefficients, those of ``equidistant`` are 0, which is not a pinhole.
    Zeros behind the last coefficient of a model are ignored.

    Args:
        name: The model, in any usual spelling: see :data:`LENS_NAMES`.
        coefficients: Its coefficients, as in ``CameraInfo.d``.

    Raises:
        CameraError: The model is not supported, or does not have this number of coefficients.

    Example:
        >>> lens_of("fisheye", [0.1, 0.0, 0.0, 0.0, 0.0])
        EquidistantLens([0.1, 0.0, 0.0, 0.0])
    """
    values = [float(value) for value in coefficients]
    shown = repr(name[:_MAX_NAME])
    if not all(np.isfinite(values)):
        raise CameraError(f"the distortion coefficients of the model {shown} contain values that are not finite")
    found = canonical_name(name)
    if found is None:
        if values and not any(values):
            return PolynomialLens()  # Coefficients of 0 are a pinhole in nearly all models.
        raise CameraError(
            f"the distortion model {shown} with {len(values)} coefficients is not supported",
            hint=f"Supported models: {join_names(LENS_NAMES)}.",
        )
    if not found:
        if any(values) and re.sub(r"[^a-z0-9]", "", name.lower()):
            raise CameraError(
                f"the distortion model {shown} has no coefficients, but there are {len(values)} that are not all zero",
                hint="Name the model of the coefficients, for example plumb_bob or equidistant.",
            )
        found = "plumb_bob"
    model = _MODELS[found]
    return model.lens(_fit_length(shown, values, model))


def _fit_length(label: str, values: list[float], model: _Model) -> list[float]:
    """Return the coefficients in a number that the model has."""
    if not any(values) and model.zeros_by_default:
        return [0.0] * model.counts[0]
    if len(values) in model.counts:
        return values
    needed = max((number + 1 for number, value in enumerate(values) if value), default=0)
    for count in model.counts:
        if needed <= count < len(values):
            return values[:count]
    counts = " or ".join(map(str, model.counts))
    raise CameraError(
        f"the distortion model {label} has {counts} coefficients ({model.coefficients}), not {len(values)}",
        hint="Copy all coefficients of the calibration, and the name of its model.",
    )
