#include "sensors/noise.h"

#include <cmath>

namespace hoap2_sim {
namespace {

std::uint64_t rotl(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

std::uint64_t next(std::uint64_t s[4]) {
  const std::uint64_t result = rotl(s[1] * 5, 7) * 9;
  const std::uint64_t t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = rotl(s[3], 45);
  return result;
}

}  // namespace

void noise_seed(std::uint64_t state[4], std::uint64_t seed) {
  for (int i = 0; i < 4; ++i) {
    seed += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    state[i] = z ^ (z >> 31);
  }
}

double noise_uniform(std::uint64_t state[4]) { return static_cast<double>(next(state) >> 11) * 0x1.0p-53; }

void noise_normal_pair(std::uint64_t state[4], double *first, double *second) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - noise_uniform(state)));
  const double angle = 6.283185307179586 * noise_uniform(state);
  *first = radius * std::cos(angle);
  *second = radius * std::sin(angle);
}

}  // namespace hoap2_sim
