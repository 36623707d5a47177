"""What the command line asked of the telemetry of a run."""

from __future__ import annotations

from dataclasses import dataclass

from hoap2.errors import UserError
from hoap2.telemetry import transport

OFF = "off"  # as --lcm: pace the run, publish nothing


@dataclass(frozen=True)
class Options:
    """realtime: keep to the wall clock. url: of --lcm. log: write telemetry.lcm. accept_commands: listen to them."""

    realtime: bool = False
    url: str | None = None
    log: bool = True
    accept_commands: bool = False

    @property
    def live_url(self) -> str | None:
        """Where to publish live, or None."""
        if self.url == OFF or not (self.realtime or self.url or self.accept_commands):
            return None
        return transport.url_or_default(self.url)

    def check(self) -> None:
        """Raise UserError when it cannot be published there."""
        if self.live_url is not None:
            transport.check_url(self.live_url)
        if self.accept_commands and not transport.hears(self.live_url):
            raise UserError("commands need a connection on which others can be heard",
                            "--accept-commands goes with --realtime, or with --lcm udpm://...")  # fmt: skip
