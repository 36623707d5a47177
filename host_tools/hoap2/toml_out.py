"""Writing TOML: tables of numbers, words and (nested) lists, shortest exact numbers."""

from __future__ import annotations

import json
import re


def _value(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        text = repr(value)
        return text if isinstance(value, int) or set(text) & set(".einf") else text + ".0"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(_value(v) for v in value) + "]"


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key)


def dumps(document: dict[str, dict], comment: str = "") -> str:
    """One `[table]` an entry; inner dictionaries become inline tables."""
    lines = [f"# {line}" for line in comment.splitlines()]
    for name, entries in document.items():
        lines += ["", f"[{_key(name)}]"]
        lines += [f"{_key(key)} = {_value(value)}" for key, value in entries.items()]
    return "\n".join(lines).lstrip() + "\n"
