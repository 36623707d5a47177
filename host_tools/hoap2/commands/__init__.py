"""One module a command: `commands/<name>.py`, imported only when that command is called.

A module holds either a function `command` with typer annotations (its docstring is the help text) or a
typer application `app = typer.Typer(add_completion=False)` with sub-commands. Heavy imports (numpy, fmpy,
matplotlib) belong inside the function.
The return value is the exit code (None is 0); `hoap2.errors.UserError` ends the command with its message.
"""
