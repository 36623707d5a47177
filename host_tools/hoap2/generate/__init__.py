"""Generator: firmware/hoap2.json and firmware/signals.toml become C, XML, URDF and pages.

Standard library only, so that it runs before anything is installed.
"""
