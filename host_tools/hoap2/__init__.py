"""hoap2: run, judge and show the balance controllers of a small humanoid.

`from hoap2 import Controller, Plant, exchange` steps both without FMI (see hoap2.binding).
"""

__version__ = "0.1.0"
__all__ = ["Controller", "Plant", "exchange"]


def __getattr__(name: str):
    # numpy and the libraries load only when they are asked for: the generator needs neither
    if name in __all__:
        from hoap2 import binding

        return getattr(binding, name)
    raise AttributeError(f"module 'hoap2' has no attribute {name!r}")
