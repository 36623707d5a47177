"""Runs a command in an emulated machine whose kernel has CAN: this computer's files, read-only, and vcan0, vcan1.

What needs Linux's CAN sockets runs there where the kernel of this machine has none (docs/can_processes.md).
"""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hoap2.can import machine_image
from hoap2.errors import UserError
from hoap2.paths import ROOT

MEMORY_MB = 768
TIMEOUT_S = 900.0
KERNEL_OPTIONS = "console=ttyS0 quiet panic=-1 mitigations=off nokaslr tsc=reliable"
WATCHERS = """
for device in {devices}; do
  candump -L $device > /run/out/candump-$device.log 2>> /run/out/candump.err &
  watching="$watching $!"
done
"""


ESCAPES = re.compile(r"\x1b(\[[?0-9;]*[A-Za-z]|[a-z])")  # of the machine's BIOS


@dataclass(frozen=True)
class Verdict:
    """How a command ended; exit_code is None when the machine ended without telling."""

    exit_code: int | None
    folder: Path  # what the command wrote to /run/out, candump's logs, and the console

    @property
    def console(self) -> str:
        return (self.folder / "console.log").read_text(errors="replace")


def _script(command: list[str]) -> str:
    devices = " ".join(machine_image.DEVICES)
    return "\n".join([
        "cd " + shlex.quote(str(ROOT)),
        "export HOME=/run TMPDIR=/run/tmp PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin",
        "export PYTHONDONTWRITEBYTECODE=1 HOAP2_MACHINE=1 PYTHONPATH=" + shlex.quote(str(ROOT / "host_tools")),
        WATCHERS.format(devices=devices),
        shlex.join(command),
        "code=$?", "kill $watching", "wait", "exit $code", "",
    ])  # fmt: skip


def _qemu(image: machine_image.Image, out: Path) -> list[str]:
    shared = "local,security_model=none"
    return ["qemu-system-x86_64", "-accel", "tcg", "-cpu", "max", "-m", str(MEMORY_MB), "-nographic", "-no-reboot",
            "-net", "none", "-kernel", str(image.kernel), "-initrd", str(image.initramfs), "-append", KERNEL_OPTIONS,
            "-virtfs", f"{shared},path=/,mount_tag=host,readonly=on,multidevs=remap",
            "-virtfs", f"{shared},path={out},mount_tag=out,multidevs=remap"]  # fmt: skip


def run(command: list[str], folder: Path, show: Callable[[str], None] = lambda line: None,
        say: Callable[[str], None] = lambda text: None, timeout_s: float = TIMEOUT_S) -> Verdict:  # fmt: skip
    """Run a command there; `show` gets each line of the console, `say` what takes long.

    folder: replaced; gets what the command leaves in /run/out. UserError where no machine can be emulated.
    """
    if why := machine_image.why_not():
        raise UserError(f"no emulated machine: {why}", "./hoap2 test socketcan installs it", 3)
    image = machine_image.image(say)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "command").write_text(_script(command))
    say("booting the machine")
    with (folder / "console.log").open("w") as console:
        machine = subprocess.Popen(_qemu(image, folder), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, errors="replace")  # fmt: skip
        timer = threading.Timer(timeout_s, machine.kill)
        timer.start()
        try:
            for line in machine.stdout:
                console.write(line)
                text = ESCAPES.sub("", line).strip()
                if text and not text.startswith(("SeaBIOS", "Booting from")):
                    show(text)
        finally:
            timer.cancel()
            machine.kill()
            machine.wait()
            machine.stdout.close()
    code = folder / "exit_code"
    told = code.read_text().strip() if code.exists() else ""
    return Verdict(int(told) if told else None, folder)


def run_tests(paths: list[str], junit: Path, options: list[str] | None = None) -> int:
    """The tests that are marked `socketcan`, there; pytest's exit code, 1 when the machine did not end well."""
    last: deque[str] = deque(maxlen=15)

    def show(line: str) -> None:
        last.append(line)
        print(line, flush=True)

    def say(text: str) -> None:
        print(f"hoap2 test: {text}", file=sys.stderr, flush=True)

    out = machine_image.FOLDER / "out"
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", f"--rootdir={ROOT}", "-c",
               str(ROOT / "pyproject.toml"), "--junitxml=/run/out/junit.xml", "--basetemp=/run/tmp/pytest", "-m",
               "socketcan", "--color=no", *(options or []), *(paths or ["tests/socketcan"])]  # fmt: skip
    verdict = run(command, out, show, say)
    if (out / "junit.xml").exists():
        junit.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(out / "junit.xml", junit)
    if verdict.exit_code is None:
        say(f"the machine ended without a verdict; its console is in {out / 'console.log'}")
        return 1
    frames = sum(sum(1 for _ in log.open()) for log in out.glob("candump-*.log"))
    say(f"candump saw {frames} frames; its logs are in {out}")
    return verdict.exit_code
