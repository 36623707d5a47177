"""The CAN interface on the host: the modelled link, and the codec of the firmware."""
