"""The monitor: what a run does, live over LCM or afterwards from its folder."""
