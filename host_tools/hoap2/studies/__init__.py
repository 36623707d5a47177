"""Studies: many runs of several scenarios, kept by what decides them, judged together."""
