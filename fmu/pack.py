"""Pack one FMU, or the SSP: a zip with fixed time stamps, so that equal inputs give equal bytes.

Standard library only: CMake runs it with the system's Python.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

FMU = Path(__file__).resolve().parent
ROOT = FMU.parent
DEFINITIONS = ("EIGEN_NO_MALLOC", "EIGEN_DONT_VECTORIZE", "EIGEN_NO_DEBUG", "EIGEN_MPL2_ONLY")
PLATFORM = {"2": "linux64", "3": "x86_64-linux"}
LICENCES = {"ode.txt": "/usr/share/doc/libode8/copyright", "libccd.txt": "/usr/share/doc/libccd2/copyright"}
LS_BUS_FILES = {
    "terminalsAndIcons/terminalsAndIcons.xml": "terminals",
    "extra/org.fmi-standard.fmi-ls-bus/fmi-ls-manifest.xml": "manifest",
}
EIGEN_LICENCE = "/usr/share/doc/libeigen3-dev/copyright"

# Every translation unit is compiled behind this: no tool-specific flags are needed for equal bits.
BUILD_HEADER = """/* Settings of every translation unit of this FMU: results equal to the bit need them. */
{definitions}
#if defined(__clang__)
#pragma clang fp contract(off)
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif
"""


def write_zip(out: Path, files: dict[str, bytes]) -> None:
    """Write files (path in the zip -> content) atomically."""
    part = out.with_suffix(out.suffix + ".part")
    with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files, key=lambda n: (n != "modelDescription.xml", n)):
            info = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (0o755 if ".so" in Path(name).name else 0o644) << 16
            archive.writestr(info, files[name])
    part.replace(out)


def dependencies(compiler: str, source: Path, include: list[str]) -> list[Path]:
    """The files that a source includes, from the compiler itself."""
    language = ["-std=c++17"] if source.suffix == ".cpp" else ["-std=c11", "-x", "c"]
    command = [compiler, *language, "-M", *[f"-D{d}" for d in DEFINITIONS], *[f"-I{i}" for i in include], str(source)]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    names = re.sub(r"\\\n", " ", text.split(":", 1)[1]).split()
    return [Path(name).resolve() for name in names]


def place_of(path: Path, eigen: Path) -> str | None:
    """Where a file goes below sources/; None for the system's own."""
    for base, prefix in ((ROOT / "firmware" / "include", ""), (ROOT / "firmware", ""), (FMU, "fmu/"), (eigen, "")):
        if path.is_relative_to(base):
            return prefix + path.relative_to(base).as_posix()
    return None


def source_files(fmi: str, compiler: str, firmware: list[str], eigen: Path) -> tuple[dict[str, bytes], list[str]]:
    """Content of sources/ and the names of the translation units, for both kinds of description."""
    shell = [
        FMU / f
        for f in (
            "instance.c",
            "values.c",
            "snapshot.c",
            f"fmi{fmi}.c",
            f"fmi{fmi}_unsupported.c",
            "no_network.c",
            *(["fmi3_no_network.c"] if fmi == "3" else []),
            "products/controller.c",
        )
    ]
    units = [Path(f).resolve() for f in firmware] + shell
    include = [str(ROOT / "firmware" / "include"), str(ROOT / "firmware"), str(eigen)]
    files: dict[str, bytes] = {}
    names = []
    for unit in units:
        for path in dependencies(compiler, unit, include):
            place = place_of(path, eigen)
            if place:
                files[place] = path.read_bytes()
        place = place_of(unit, eigen)
        wrapper = "units/" + place.replace("/", "_")
        files[wrapper] = f'#include "../hoap2_build.h"\n#include "../{place}"\n'.encode()
        names.append(wrapper)
    definitions = "\n".join(f"#ifndef {d}\n#define {d}\n#endif" for d in DEFINITIONS)
    files["hoap2_build.h"] = BUILD_HEADER.format(definitions=definitions).encode()
    return files, names


def build_description(units: list[str]) -> str:
    inner = "\n".join(f"      <SourceFile name={quoteattr(name)}/>" for name in units)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<fmiBuildDescription fmiVersion="3.0">\n'
        '  <BuildConfiguration modelIdentifier="hoap2_controller" description="Shared library of the controller">\n'
        '    <SourceFileSet name="all" language="C++17">\n'
        f"{inner}\n"
        '      <IncludeDirectory name="."/>\n    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n'
    )


def licences(product: str, with_eigen: bool) -> dict[str, bytes]:
    """documentation/licenses: the project's, and those of what is linked in or lies beside it."""
    found = {"documentation/licenses/LICENSE.txt": (ROOT / "LICENSE").read_bytes()}
    wanted = dict(LICENCES) if product == "plant" else {}
    if with_eigen:
        wanted["eigen.txt"] = EIGEN_LICENCE
    for name, path in wanted.items():
        if Path(path).exists():
            found[f"documentation/licenses/{name}"] = Path(path).read_bytes()
        else:
            print(f"pack.py: {path} is not on this machine: {name} is left out", file=sys.stderr)
    return found


def pack_fmu(args: argparse.Namespace) -> None:
    files: dict[str, bytes] = {}
    generated = FMU / "ls_bus" / "generated" if args.ls_bus else FMU / "generated"
    name = args.product if args.ls_bus else f"{args.product}_fmi{args.fmi}"
    xml = (generated / f"{name}.xml").read_text()
    if args.firmware:
        eigen = Path(args.eigen)
        sources, units = source_files(args.fmi, args.compiler, args.firmware, eigen)
        files |= {f"sources/{name}": content for name, content in sources.items()}
        if args.fmi == "3":
            files["sources/buildDescription.xml"] = build_description(units).encode()
        else:
            listed = "\n".join(f"      <File name={quoteattr(name)}/>" for name in units)
            xml = xml.replace("@SOURCE_FILES@", f"    <SourceFiles>\n{listed}\n    </SourceFiles>")
    files["modelDescription.xml"] = xml.replace("@SOURCE_FILES@", "").encode()
    files["documentation/index.html"] = (generated / f"{args.product}.html").read_bytes()
    if args.ls_bus:
        for place, kind in LS_BUS_FILES.items():
            files[place] = (generated / f"{args.product}_{kind}.xml").read_bytes()
    icon = (FMU / "icon.png").read_bytes()
    files["documentation/robot.png"] = icon
    files["model.png" if args.fmi == "2" else "terminalsAndIcons/icon.png"] = icon
    files |= licences(args.product, bool(args.firmware) or args.product == "controller")
    folder = f"binaries/{PLATFORM[args.fmi]}"
    files[f"{folder}/{Path(args.binary).name}"] = Path(args.binary).read_bytes()
    for library in args.library:
        files[f"{folder}/{Path(library).name}"] = Path(library).resolve().read_bytes()
    write_zip(Path(args.out), files)


def pack_ssp(args: argparse.Namespace) -> None:
    files = {"SystemStructure.ssd": (FMU / "generated" / "SystemStructure.ssd").read_bytes()}
    files |= {f"resources/{Path(f).name}": Path(f).read_bytes() for f in args.fmu}
    files["documentation/LICENSE.txt"] = (ROOT / "LICENSE").read_bytes()
    write_zip(Path(args.out), files)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    kinds = parser.add_subparsers(required=True)
    fmu = kinds.add_parser("fmu")
    fmu.add_argument("--out", required=True)
    fmu.add_argument("--fmi", choices=("2", "3"), required=True)
    fmu.add_argument("--product", choices=("controller", "plant", "can_bus"), required=True)
    fmu.add_argument("--ls-bus", action="store_true", help="the flavour with bus terminals")
    fmu.add_argument("--binary", required=True)
    fmu.add_argument("--library", nargs="*", default=[], help="shared libraries that lie beside the binary")
    fmu.add_argument("--firmware", nargs="*", default=[], help="firmware sources to carry along")
    fmu.add_argument("--compiler", default="c++")
    fmu.add_argument("--eigen", default="/usr/include/eigen3")
    fmu.set_defaults(run=pack_fmu)
    ssp = kinds.add_parser("ssp")
    ssp.add_argument("--out", required=True)
    ssp.add_argument("--fmu", nargs="+", required=True)
    ssp.set_defaults(run=pack_ssp)
    args = parser.parse_args()
    args.run(args)


if __name__ == "__main__":
    main()
