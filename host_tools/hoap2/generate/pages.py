"""Documentation tables of the signals."""

from __future__ import annotations

import math

from .tables import GROUPS, PRODUCTS, Table


def signals_page(table: Table) -> str:
    out = ["# Signals", "", "Generated from `firmware/signals.toml`: do not edit. Frames: W world, S sensor (chest axes), L link.", ""]
    for product in PRODUCTS:
        for group in GROUPS:
            out += [f"## {product} {group}s", "", "| name | size | unit | default | range | |", "|---|---|---|---|---|---|"]
            for s in table.select(product, group):
                size = " x ".join(s.size_names) or "1"
                default = f"{s.default[0]:g}" if len(set(s.default)) == 1 else "per element"
                span = f"{s.low:g} ... {s.high:g}" if not math.isinf(s.low) else ""
                span += " (tunable)" if s.tunable else ""
                text = s.text + (f" ({', '.join(f'{i} {n}' for i, n in enumerate(table.enums[s.enum]))})" if s.enum else "")
                text += ". From the operator" if s.operator else ""
                out.append(f"| `{s.name}` | {size} | {s.unit if s.kind == 'real' else 'int'} | {default} | {span} | {text} |")
            out.append("")
    joints = ", ".join(f"{i} {n}" for i, n in enumerate(table.labels["joint"]))
    faults = "\n".join(f"- {bit} `{name}`: {table.fault_texts[name]}" for name, bit in table.faults.items())
    out += ["## Order of the joints", "", joints, "", "## Fault bits", "", faults, ""]
    return "\n".join(out)
