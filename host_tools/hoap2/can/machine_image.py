"""What the emulated machine boots: a Debian kernel with CAN, and a first file system with busybox and its modules.

Made once into build/machine/: the kernel's package is downloaded and unpacked there, not installed.
"""

from __future__ import annotations

import lzma
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from hoap2.errors import UserError
from hoap2.paths import ROOT

FOLDER = ROOT / "build" / "machine"
# In the order in which they are loaded; each needs some before it.
MODULES = (
    "net/can/can", "net/can/can-raw", "drivers/net/can/dev/can-dev", "drivers/net/can/vcan", "fs/netfs/netfs",
    "fs/fscache/fscache", "net/9p/9pnet", "fs/9p/9p", "drivers/virtio/virtio_ring", "drivers/virtio/virtio",
    "net/9p/9pnet_virtio", "drivers/virtio/virtio_pci_modern_dev", "drivers/virtio/virtio_pci_legacy_dev",
    "drivers/virtio/virtio_pci",
)  # fmt: skip
DEVICES = ("vcan0", "vcan1")
FD_MTU = 72
XZ_MAGIC = b"\xfd7zXZ\x00"
BUSYBOX = Path("/bin/busybox")

# The first program. The computer outside is /host, read-only; what the guest says goes to the console and /out.
INIT = """#!/bin/busybox sh
/bin/busybox --install -s /bin
mkdir -p /proc /sys /dev /host
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
for module in {modules}; do insmod /modules/$module.ko || echo "machine: $module does not load"; done
for device in {devices}; do
  ip link add dev $device type vcan && ip link set dev $device mtu {mtu} up || echo "machine: no $device"
done
ip link set lo up
options=trans=virtio,version=9p2000.L,msize=262144
mount -t 9p -o $options,ro,cache=loose host /host || echo "machine: no host file system"
mount -t proc proc /host/proc
mount -t sysfs sys /host/sys
mount -t devtmpfs dev /host/dev
mount -t tmpfs tmp /host/run
mkdir -p /host/run/out /host/run/tmp
mount -t 9p -o $options out /host/run/out || echo "machine: nowhere to write"
chroot /host /bin/sh /run/out/command
echo $? > /host/run/out/exit_code
sync
poweroff -f
"""


@dataclass(frozen=True)
class Image:
    """Files of qemu-system-x86_64."""

    kernel: Path
    initramfs: Path


def why_not() -> str:
    """Why no machine can be emulated here; an empty text when it can."""
    if not shutil.which("qemu-system-x86_64"):
        return "qemu-system-x86_64 is not installed (Debian: qemu-system-x86)"
    if not BUSYBOX.exists():
        return "busybox is not installed (Debian: busybox-static)"
    if not shutil.which("candump"):
        return "candump is not installed (Debian: can-utils)"
    return ""


def _run(command: list[str], folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=600)
    if done.returncode:
        said = (done.stderr or done.stdout).strip().splitlines()[-1:]
        raise UserError(f"{' '.join(command[:3])}: {' '.join(said)}", "is the package index there? apt-get update", 3)
    return done.stdout


def _kernel_package() -> str:
    found = re.search(r"Depends: (linux-image-\S+)", _run(["apt-cache", "depends", "linux-image-amd64"], ROOT))
    if not found:
        raise UserError("Debian's package index has no linux-image-amd64", "apt-get update", 3)
    return found[1]


def _unpacked(package: str, folder: Path) -> Path:
    """The kernel's package, downloaded and unpacked."""
    _run(["apt-get", "download", package], folder)
    (archive,) = folder.glob("*.deb")
    _run(["dpkg-deb", "-x", archive.name, "kernel"], folder)
    archive.unlink()
    return folder / "kernel"


def _plain_kernel(compressed: bytes) -> bytes:
    """The kernel within a bzImage: it starts in half the time."""
    start = compressed.find(XZ_MAGIC)
    if start < 0:
        return compressed
    return lzma.LZMADecompressor(lzma.FORMAT_XZ).decompress(compressed[start:])


def _initramfs(modules: Path, folder: Path) -> None:
    root = folder / "root"
    for name in ("bin", "modules"):
        (root / name).mkdir(parents=True)
    shutil.copy(BUSYBOX, root / "bin" / "busybox")
    for module in MODULES:
        shutil.copy(modules / "kernel" / f"{module}.ko", root / "modules")
    init = root / "init"
    init.write_text(INIT.format(modules=" ".join(Path(m).name for m in MODULES), devices=" ".join(DEVICES), mtu=FD_MTU))
    init.chmod(0o755)
    _run(["sh", "-c", f"find . | {BUSYBOX} cpio -o -H newc | gzip -1 > ../initramfs.gz"], root)


def image(say=lambda text: None) -> Image:
    """The image, made when it is not there or another recipe made it."""
    made = Image(FOLDER / "vmlinux", FOLDER / "initramfs.gz")
    stamp, recipe = FOLDER / "recipe", f"{INIT}{MODULES}{DEVICES}{FD_MTU}"
    if made.kernel.exists() and stamp.exists() and stamp.read_text() == recipe:
        return made
    work = FOLDER / "making"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    package = _kernel_package()
    say(f"downloading {package} (70 MB, once)")
    unpacked = _unpacked(package, work)
    (modules,) = (unpacked / "lib" / "modules").iterdir()
    (kernel,) = (unpacked / "boot").glob("vmlinuz-*")
    say("making the machine's kernel and first file system")
    _initramfs(modules, work)
    (work / "vmlinux").write_bytes(_plain_kernel(kernel.read_bytes()))
    for file in (made.kernel, made.initramfs):
        (work / file.name).replace(file)
    shutil.rmtree(work)
    stamp.write_text(recipe)
    return made
