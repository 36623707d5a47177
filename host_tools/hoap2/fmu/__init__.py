"""The FMUs from Python: build them, judge them, run them."""
