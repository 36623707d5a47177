"""Errors that are the user's to mend."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class UserError(Exception):
    """Bad usage or bad input: the command line prints it in one line and exits with exit_code.

    message says what is wrong, hint what to do about it.
    """

    def __init__(self, message: str, hint: str = "", exit_code: int = 2) -> None:
        super().__init__(f"{message}; {hint}" if hint else message)
        self.message = message
        self.hint = hint
        self.exit_code = exit_code


def nearest(name: str, known: Iterable[str]) -> str:
    """`did you mean 'x'?` for the nearest known name, or an empty text when none is near."""
    match = difflib.get_close_matches(name, list(known), 1)
    return f"did you mean '{match[0]}'?" if match else ""
