# SPDX-License-Identifier: Apache-2.0
"""SE(3) in other libraries: each operation is a function without arguments, `matrices` makes its result comparable."""

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.measuring import MissingPeerError
from benchmarks.peers import package
from coframe import Transform

Operations = dict[str, Callable[[], Any]]


class Ours:
    """coframe. The other classes have the same arguments.

    Args:
        twists: (N, 6), linear before angular.
        a: N poses.
        b: N poses.
        fractions: (N,).
    """

    def __init__(self, twists: Any, a: Transform, b: Transform, fractions: Any) -> None:
        self.operations: Operations = {
            "exp": lambda: Transform.exp(twists),
            "log": a.log,
            "compose": lambda: a @ b,
            "inverse": a.inverse,
            "interpolate": lambda: a.interpolate(b, fractions),
            "interpolate along screws": lambda: a.interpolate(b, fractions, interpolation="screw"),
        }

    def matrices(self, result: Any) -> Any:
        return result.matrix if isinstance(result, Transform) else result


class Scipy:
    """SciPy has no interpolation of rigid transforms: rotations by hand, as in its documentation."""

    def __init__(self, twists: Any, a: Transform, b: Transform, fractions: Any) -> None:
        scipy = package("scipy.spatial.transform")
        if not hasattr(scipy, "RigidTransform"):
            raise MissingPeerError("pip install -U scipy")
        given = np.concatenate([twists[:, 3:], twists[:, :3]], axis=1)
        first, second = a.as_rigid_transform(), b.as_rigid_transform()

        def interpolate() -> Any:
            turn = first.rotation * scipy.Rotation.from_rotvec(
                fractions[:, None] * (first.rotation.inv() * second.rotation).as_rotvec()
            )
            line = first.translation + fractions[:, None] * (second.translation - first.translation)
            return scipy.RigidTransform.from_components(line, turn)

        self.operations: Operations = {
            "exp": lambda: scipy.RigidTransform.from_exp_coords(given),
            "log": first.as_exp_coords,
            "compose": lambda: first * second,
            "inverse": first.inv,
            "interpolate": interpolate,
        }

    def matrices(self, result: Any) -> Any:
        if isinstance(result, np.ndarray):
            return np.concatenate([result[:, 3:], result[:, :3]], axis=1)
        return result.as_matrix()


class Pytransform3d:
    """Batches of pytransform3d, whose only interpolation follows screws."""

    def __init__(self, twists: Any, a: Transform, b: Transform, fractions: Any) -> None:
        library = package("pytransform3d.trajectories")
        given = np.concatenate([twists[:, 3:], twists[:, :3]], axis=1)
        first, second = a.matrix, b.matrix
        starts, ends = (library.dual_quaternions_from_transforms(each) for each in (first, second))
        self.operations: Operations = {
            "exp": lambda: library.transforms_from_exponential_coordinates(given),
            "log": lambda: library.exponential_coordinates_from_transforms(first),
            "compose": lambda: first @ second,
            "interpolate along screws": lambda: library.transforms_from_dual_quaternions(
                library.dual_quaternions_sclerp(starts, ends, fractions)
            ),
        }

    def matrices(self, result: Any) -> Any:
        return np.concatenate([result[:, 3:], result[:, :3]], axis=1) if result.shape[-1] == 6 else result


class Jaxlie:
    """jaxlie, compiled before it is measured, with float64."""

    def __init__(self, twists: Any, a: Transform, b: Transform, fractions: Any) -> None:
        del fractions
        try:
            jax, jaxlie = importlib.import_module("jax"), importlib.import_module("jaxlie")
        except ImportError:
            raise MissingPeerError("pip install jaxlie") from None
        jax.config.update("jax_enable_x64", True)
        self.SE3: Any = jaxlie.SE3

        def rows(pose: Transform) -> Any:
            x, y, z, w = pose.quaternion.T
            return jax.numpy.asarray(np.stack([w, x, y, z, *pose.translation.T], axis=1))

        first, second, given = rows(a), rows(b), jax.numpy.asarray(twists)
        exp = jax.jit(jax.vmap(lambda each: jaxlie.SE3.exp(each).wxyz_xyz))
        log = jax.jit(jax.vmap(lambda each: jaxlie.SE3(each).log()))
        compose = jax.jit(jax.vmap(lambda one, other: (jaxlie.SE3(one) @ jaxlie.SE3(other)).wxyz_xyz))
        self.operations: Operations = {
            "exp": lambda: exp(given).block_until_ready(),
            "log": lambda: log(first).block_until_ready(),
            "compose": lambda: compose(first, second).block_until_ready(),
        }

    def matrices(self, result: Any) -> Any:
        rows = np.asarray(result)
        return rows if rows.shape[1] == 6 else np.asarray(self.SE3(rows[:100]).as_matrix())


class Pinocchio:
    """Pinocchio, which computes one pose after the other."""

    def __init__(self, twists: Any, a: Transform, b: Transform, fractions: Any) -> None:
        try:
            pin = importlib.import_module("pinocchio")
        except ImportError:
            raise MissingPeerError("make .venv/.oracle") from None
        first, second = a.as_pinocchio(), b.as_pinocchio()
        given = list(twists)
        self.operations: Operations = {
            "exp": lambda: [pin.exp6(each) for each in given],
            "log": lambda: [pin.log6(each).vector for each in first],
            "compose": lambda: [one * other for one, other in zip(first, second, strict=True)],
            "interpolate along screws": lambda: [
                pin.SE3.Interpolate(one, other, s) for one, other, s in zip(first, second, fractions, strict=True)
            ],
        }

    def matrices(self, result: Any) -> Any:
        return np.array([getattr(each, "homogeneous", each) for each in result])
