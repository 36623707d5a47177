"""LCM telemetry: what a run publishes and logs, and how it is received and read.

types      the messages, their channels, decoding with checks
transport  URLs and connections
listen     a listener with counters
"""
