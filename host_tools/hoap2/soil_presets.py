"""Named soils: sim/soil/presets.toml, one table each, for `[soil] preset = "..."` of a scenario."""

from __future__ import annotations

import tomllib

from hoap2 import parameters
from hoap2.errors import UserError, nearest
from hoap2.generate.tables import ROOT

FILE = ROOT / "sim" / "soil" / "presets.toml"
WORDS = {"title", "source"}  # what a preset says of itself


def load() -> dict[str, dict]:
    """Each preset by its name: title, source and plant parameters."""
    try:
        return tomllib.loads(FILE.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError) as error:
        raise UserError(f"{FILE}: {error}") from None


def resolve(raw: dict, forced: set[str]) -> dict[str, object]:
    """The plant parameters of the preset that a raw scenario's [soil] names; none without it.

    forced: names that the command line sets, to tell a preset asked for in vain from a scenario's own.
    """
    table = raw.get("soil", {})
    for key in table:
        if key != "preset":
            raise parameters.unknown("key of [soil]", key, {"preset"})
    if "preset" not in table:
        return {}
    presets, name = load(), table["preset"]
    if name not in presets:
        hint = nearest(str(name), presets)
        raise UserError(f"unknown soil preset '{name}'", (f"{hint} " if hint else "") + f"known: {', '.join(presets)}")
    if "soil.preset" in forced and raw.get("plant", {}).get("ground") not in ("soil", 1):
        raise UserError("soil.preset has no effect on the rigid floor", "add --set plant.ground=soil")
    return {key: value for key, value in presets[name].items() if key not in WORDS}
