// The plant's own random numbers (xoshiro256**, seeded by splitmix64): no global
// generator, state in the plant's block.
#ifndef HOAP2_SIM_SENSORS_NOISE_H
#define HOAP2_SIM_SENSORS_NOISE_H

#include <cstdint>

namespace hoap2_sim {

void noise_seed(std::uint64_t state[4], std::uint64_t seed);
double noise_uniform(std::uint64_t state[4]);  // [0, 1)
// Two independent standard normal numbers (Box-Muller).
void noise_normal_pair(std::uint64_t state[4], double *first, double *second);

}  // namespace hoap2_sim
#endif
