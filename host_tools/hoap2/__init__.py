"""hoap2: run, judge and show the balance controllers of a small humanoid."""

__version__ = "0.1.0"
