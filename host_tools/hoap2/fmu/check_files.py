"""Checks of the files: schemas, fmpy's validation, contents, libraries, the sources."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import fmpy
import fmpy.build
import fmpy.validation
from lxml import etree

from ..generate.ssp import connections
from ..generate.tables import PRODUCTS, load
from .build import VERSIONS
from .check import Check, Context, require, require_equal
from .instance import FmuArchive, FmuFileError, FmuInstance
from .pair import replay

SCHEMAS = Path(fmpy.__file__).parent / "schema"
SSP_SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"


def subjects() -> list[tuple[str, int]]:
    return [(product, version) for product in PRODUCTS for version in VERSIONS]


def validate(context: Context, product: str, version: int) -> str:
    problems = fmpy.validation.validate_fmu(str(context.files.fmu(product, version)))
    require(not problems, "; ".join(problems[:3]))
    return "no findings"


def schema_findings(text: bytes, schema: Path) -> list[str]:
    judge = etree.XMLSchema(etree.parse(str(schema)))
    document = etree.fromstring(text)
    return [] if judge.validate(document) else [str(e) for e in judge.error_log][:3]


def schemas(context: Context, product: str, version: int) -> str:
    """XML files against the schemas of the standard that fmpy ships."""
    folder = SCHEMAS / f"fmi{version}"
    wanted = {
        "modelDescription.xml": f"fmi{version}ModelDescription.xsd",
        "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    }
    judged = []
    with zipfile.ZipFile(context.files.fmu(product, version)) as archive:
        for name in [n for n in wanted if n in archive.namelist()]:
            text = archive.read(name)
            require(b"xmlns:xsi" not in text, f"{name} names the schema instance, which some importers refuse")
            findings = schema_findings(text, folder / wanted[name])
            require(not findings, f"{name}: {'; '.join(findings)}")
            judged.append(Path(name).name)
    return ", ".join(judged)


def contents(context: Context, product: str, version: int) -> str:
    """Documentation that names every variable, licences, binary, libraries or sources."""
    folder = f"binaries/{fmpy.platform if version == 2 else fmpy.platform_tuple}"
    wanted = {f"{folder}/hoap2_{product}.so", "documentation/index.html", "documentation/licenses/LICENSE.txt"}
    licences = ("ode.txt", "libccd.txt") if product == "plant" else ("eigen.txt",)
    wanted |= {f"documentation/licenses/{name}" for name in licences}
    if product == "plant":
        wanted |= {f"{folder}/libode.so.8", f"{folder}/libccd.so.2"}
    with zipfile.ZipFile(context.files.fmu(product, version)) as archive:
        names = set(archive.namelist())
        require(wanted <= names, f"missing: {', '.join(sorted(wanted - names))}")
        page = archive.read("documentation/index.html").decode()
    missing = [s.name for s in load().signals if s.product == product and f"<code>{s.name}</code>" not in page]
    require(not missing, f"not in the documentation: {', '.join(missing[:5])}")
    return f"{len(names)} files"


def libraries(context: Context, version: int) -> str:
    """The plant's libraries come from its own folder, and nothing else from outside the C library."""
    with FmuArchive(context.files.fmu("plant", version)) as archive:
        environment = {k: v for k, v in os.environ.items() if k != "LD_LIBRARY_PATH"}
        text = subprocess.run(
            ["ldd", str(archive.binary)], capture_output=True, text=True, check=True, env=environment
        ).stdout
        own = {line.split()[0]: line.split()[2] for line in text.splitlines() if "=>" in line}
        for name in ("libode.so.8", "libccd.so.2"):
            place = own.get(name, "nowhere")
            require(Path(place).parent.resolve() == archive.binary.parent.resolve(), f"{name} comes from {place}")
    return "libode, libccd beside the binary are used"


def source_build(context: Context, version: int) -> str:
    """The zip's sources alone, compiled by fmpy, give the same bytes as the binary."""
    folder = context.scratch / f"source_fmi{version}"
    with zipfile.ZipFile(context.files.fmu("controller", version)) as archive:
        archive.extractall(folder)
    binary = next(folder.glob("binaries/*/*.so"))
    binary.unlink()
    with contextlib.redirect_stdout(io.StringIO()):
        _fmpy_compile(folder)
    require(binary.exists(), "the compilation left no binary")
    rebuilt = context.scratch / f"rebuilt_fmi{version}.fmu"
    with zipfile.ZipFile(rebuilt, "w") as archive:
        for path in (folder / "modelDescription.xml", binary):
            archive.write(path, path.relative_to(folder))
    recorded = context.loop(version)["controller"]
    with FmuInstance(rebuilt) as fmu:
        fmu.initialize()
        require_equal(replay(fmu, recorded), recorded, "rebuilt from sources")
    return f"compiled by fmpy; {len(recorded.inputs_real)} ticks equal"


def _fmpy_compile(folder: Path) -> None:
    """`fmpy compile` in a process of its own: it talks, and it takes the first cmake in PATH."""
    build = folder / "build"
    build.mkdir()
    program = (
        "import sys; from fmpy.build import build_platform_binary as b; "
        "b(sys.argv[1], sys.argv[2], generator='Ninja' if __import__('shutil').which('ninja') else None)"
    )
    environment = os.environ | {"PATH": "/usr/bin:/bin:" + os.environ.get("PATH", "")}
    done = subprocess.run(
        [sys.executable, "-c", program, str(folder), str(build)], capture_output=True, text=True, env=environment
    )
    last = "; ".join((done.stdout + done.stderr).strip().splitlines()[-3:])
    require(done.returncode == 0, f"fmpy cannot compile the sources: {last}")


def ssp(context: Context) -> str:
    """The SSP: schema, both FMUs inside unchanged, every connection once."""
    table = load()
    with zipfile.ZipFile(context.files.ssp) as archive:
        text = archive.read("SystemStructure.ssd")
        for product in PRODUCTS:
            inside = archive.read(f"resources/hoap2_{product}_fmi2.fmu")
            require(inside == context.files.fmu(product, 2).read_bytes(), f"the {product} FMU inside is another one")
    findings = schema_findings(text, SSP_SCHEMAS / "SystemStructureDescription.xsd")
    require(not findings, "; ".join(findings))
    root = etree.fromstring(text)
    found = [
        tuple(c.get(k) for k in ("startElement", "startConnector", "endElement", "endConnector"))
        for c in root.iter(f"{SSD}Connection")
    ]
    require(
        len(found) == len(set(found)) and set(found) == set(connections(table)), "connections are missing or double"
    )
    inputs = sum(s.count for s in table.signals if s.group == "input" and not s.operator)
    require(len(found) == inputs, f"{len(found)} connections for {inputs} inputs")
    return f"{len(found)} connections, every input driven but the operator's"


def _damaged(context: Context) -> dict[str, Path]:
    """Files that are no FMUs, each in its own way."""
    good = context.files.fmu("plant", 3).read_bytes()
    made = {}
    middle = len(good) // 2
    for name, content in {
        "cut": good[:middle],
        "empty": b"",
        "text": b"not an FMU\n",
        "flipped": good[:middle] + bytes([good[middle] ^ 0xFF]) + good[middle + 1 :],
    }.items():
        made[name] = context.scratch / f"{name}.fmu"
        made[name].write_bytes(content)
    for name, keep in {"no_description": "binaries/", "no_binary": "modelDescription.xml"}.items():
        made[name] = context.scratch / f"{name}.fmu"
        with zipfile.ZipFile(context.files.fmu("plant", 3)) as source, zipfile.ZipFile(made[name], "w") as target:
            for item in source.namelist():
                if item.startswith(keep):
                    target.writestr(item, source.read(item))
    made["missing"] = context.scratch / "missing.fmu"
    return made


def damaged_files(context: Context) -> str:
    """A damaged FMU is a clear error that names the file."""
    cases = _damaged(context)
    for name, path in cases.items():
        try:
            FmuInstance(path, "plant").close()
        except FmuFileError as e:
            require(str(path) in str(e), f"{name}: the error does not name the file: {e}")
        else:
            require(False, f"a damaged FMU ({name}) was accepted")
    return f"{len(cases)} kinds of damage, each a clear error"


def checks(quick: bool) -> list[Check]:
    """The checks of this file."""
    found: list[Check] = []
    each: dict[str, Callable[[Context, str, int], str]] = {
        "fmpy validate": validate,
        "XML schemas": schemas,
        "contents": contents,
    }
    for name, function in each.items():
        found += [Check(name, f"{p} FMI {v}", lambda c, f=function, p=p, v=v: f(c, p, v)) for p, v in subjects()]
    found += [Check("own libraries", f"plant FMI {v}", lambda c, v=v: libraries(c, v)) for v in VERSIONS]
    found.append(Check("connections", "hoap2.ssp", ssp))
    found.append(Check("damaged FMU refused", "any FMU", damaged_files))
    if not quick:
        found += [
            Check("built from its sources", f"controller FMI {v}", lambda c, v=v: source_build(c, v)) for v in VERSIONS
        ]
    return found
