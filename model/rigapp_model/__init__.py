"""Physics of mechanism, joint, bushing and wear: arrays in, arrays out, SI units, no I/O."""
