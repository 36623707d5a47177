"""What things cost on this machine: `plant` the plant beside other simulators, `chain` a whole run and its parts."""
