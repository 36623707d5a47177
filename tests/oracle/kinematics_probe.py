"""The firmware's kinematics through the C probe library of tests/firmware."""

from __future__ import annotations

import ctypes
import os
import subprocess
from pathlib import Path

import numpy as np

JOINTS = 25
LINKS = 26


def build_probe(repo_root: Path) -> Path:
    """Bring the probe library up to date and say where it is.

    It comes from the tests' build where there is one, else from a small build of its own (no plant, no pictures);
    either way it is never older than the sources. HOAP2_KINEMATICS_PROBE names a library to be taken instead.
    """
    given = os.environ.get("HOAP2_KINEMATICS_PROBE")
    if given:
        return Path(given)
    build = repo_root / "build" / "host"
    commands = []
    if not (build / "build.ninja").exists():
        build = repo_root / "build" / "oracle"
        commands.append(["cmake", "-S", str(repo_root), "-B", str(build), "-DHOAP2_SIM=OFF", "-DHOAP2_TESTS=ON",
                         "-DCMAKE_BUILD_TYPE=Release"])
    commands.append(["cmake", "--build", str(build), "--target", "hoap2_kinematics_probe"])
    for command in commands:
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}")
    return build / "tests" / "firmware" / "libhoap2_kinematics_probe.so"


def _doubles(values: np.ndarray) -> ctypes._Pointer:
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


class KinematicsProbe:
    """Numpy in, numpy out; every frame and point in the pelvis frame."""

    def __init__(self, library: Path) -> None:
        self._library = ctypes.CDLL(str(library))

    def link_poses(self, q_rad: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rotations (26, 3, 3) and origins (26, 3) of the links, CoM (3)."""
        rotations, positions, com = np.zeros((LINKS, 3, 3)), np.zeros((LINKS, 3)), np.zeros(3)
        self._library.probe_link_poses(_doubles(q_rad), _doubles(rotations), _doubles(positions), _doubles(com))
        return rotations, positions, com

    def sole_pose(self, q_rad: np.ndarray, foot: int) -> tuple[np.ndarray, np.ndarray]:
        """Rotation and position of the sole frame; foot 0 right, 1 left."""
        rotation, position = np.zeros((3, 3)), np.zeros(3)
        self._library.probe_sole_pose(_doubles(q_rad), foot, _doubles(rotation), _doubles(position))
        return rotation, position

    def com_jacobian(self, q_rad: np.ndarray) -> np.ndarray:
        """(3, 25)"""
        jacobian = np.zeros((3, JOINTS))
        self._library.probe_com_jacobian(_doubles(q_rad), _doubles(jacobian))
        return jacobian

    def point_jacobian(self, q_rad: np.ndarray, link: int, point_link_m: np.ndarray) -> np.ndarray:
        """(6, 25), linear first, of a point fixed to a link."""
        jacobian = np.zeros((6, JOINTS))
        self._library.probe_point_jacobian(_doubles(q_rad), link, _doubles(point_link_m), _doubles(jacobian))
        return jacobian
