"""Tells the python-can of this environment of the `hoap2_unix` interface, so that its own tools find it by name.

A distribution of two small files beside the other packages: the entry point, and the path of host_tools.
"""

from __future__ import annotations

import sysconfig
from pathlib import Path

from hoap2 import __version__
from hoap2.paths import ROOT

ENTRY_POINTS = "[can.interface]\nhoap2_unix = hoap2.can.unix_bus:UnixBus\n"


def files(site: Path) -> dict[Path, str]:
    """Path -> content of what is installed below site."""
    info = site / f"hoap2_can_interface-{__version__}.dist-info"
    path_file = site / "hoap2_can_interface.pth"
    texts = {
        info / "METADATA": f"Metadata-Version: 2.1\nName: hoap2-can-interface\nVersion: {__version__}\n"
                           "Summary: The hoap2_unix interface for python-can\n",
        info / "INSTALLER": "hoap2\n",
        info / "entry_points.txt": ENTRY_POINTS,
        path_file: f"{ROOT / 'host_tools'}\n",
    }  # fmt: skip
    record = [f"{p.relative_to(site)},," for p in (*texts, info / "RECORD")]
    return {**texts, info / "RECORD": "\n".join(record) + "\n"}


def install(site: Path | None = None) -> bool:
    """Write what is missing or different; whether anything was."""
    wanted = files(site or Path(sysconfig.get_path("purelib")))
    stale = {p: t for p, t in wanted.items() if not p.exists() or p.read_text() != t}
    for path, text in stale.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return bool(stale)


if __name__ == "__main__":
    install()
