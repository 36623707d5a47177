"""These tests run in the emulated machine (./hoap2 test socketcan); elsewhere tests/host/test_machine.py runs it."""

from __future__ import annotations

from hoap2.can.interfaces import can_devices

collect_ignore_glob = [] if "vcan0" in can_devices() else ["test_*.py"]
