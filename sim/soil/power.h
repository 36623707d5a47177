// z^n for one exponent, several times faster than pow() and the same on every machine:
// z = 2^e m_i (1 + r) with 2^(e n) and m_i^n from tables and six terms of (1 + r)^n.
// Relative error below 1e-14.
#ifndef HOAP2_SIM_SOIL_POWER_H
#define HOAP2_SIM_SOIL_POWER_H

#include <cmath>
#include <cstdint>
#include <cstring>

namespace hoap2_sim {

class Power {
 public:
  void build(double exponent) {
    exponent_ = exponent;
    is_linear_ = exponent == 1.0;
    for (int i = 0; i < kNodes; ++i) {
      const double middle = 1.0 + (i + 0.5) / kNodes;
      inverse_[i] = 1.0 / middle;
      node_[i] = std::pow(middle, exponent);
    }
    for (int e = kLow; e < kHigh; ++e) two_[e - kLow] = std::pow(2.0, e * exponent);
    double binomial = 1.0;
    for (int i = 0; i < kTerms; ++i) {
      binomial *= (exponent - i) / (i + 1);
      term_[i] = binomial;
    }
  }

  // z up to 2^kHigh; 0 for z below 2^kLow.
  double operator()(double z) const {
    if (is_linear_) return z;
    std::uint64_t bits;
    std::memcpy(&bits, &z, sizeof bits);
    const int e = static_cast<int>(bits >> 52) - 1023;  // a negative z gives a large e
    if (e < kLow) return 0.0;
    if (e >= kHigh) return z > 0.0 ? std::pow(z, exponent_) : 0.0;
    const auto i = static_cast<unsigned>((bits >> 46) & (kNodes - 1));
    bits = (bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL;
    double mantissa;
    std::memcpy(&mantissa, &bits, sizeof mantissa);
    const double r = mantissa * inverse_[i] - 1.0;
    double sum = term_[kTerms - 1];
    for (int k = kTerms - 2; k >= 0; --k) sum = sum * r + term_[k];
    return two_[e - kLow] * node_[i] * (1.0 + r * sum);
  }

 private:
  static constexpr int kNodes = 64, kTerms = 6, kLow = -60, kHigh = 8;
  double exponent_ = 1.0;
  bool is_linear_ = true;
  double inverse_[kNodes] = {}, node_[kNodes] = {}, two_[kHigh - kLow] = {}, term_[kTerms] = {};
};

}  // namespace hoap2_sim
#endif
