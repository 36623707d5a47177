// The firmware's own sine, cosine, atan2, hypot, exp: special values, symmetries, and the bits themselves.
// Their accuracy against an independent oracle: tests/oracle/test_scalar_math.py.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/scalar_math.h"

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kPi = 0x1.921fb54442d18p+1;

uint64_t bits(double x) {
  uint64_t out;
  std::memcpy(&out, &x, sizeof out);
  return out;
}

// The same value and the same sign, for zeros too; any NaN is as good as another.
void expect_same(double wanted, double got) {
  if (std::isnan(wanted)) {
    EXPECT_TRUE(std::isnan(got)) << got;
  } else {
    EXPECT_EQ(bits(wanted), bits(got)) << wanted << " " << got;
  }
}

TEST(ScalarMath, SineAndCosineOfSpecialValues) {
  for (double x : {0.0, kLeast, 1e-310, 0x1p-30}) {
    expect_same(x, hoap2_sin(x));
    expect_same(-x, hoap2_sin(-x));
    expect_same(1.0, hoap2_cos(x));
  }
  for (double x : {kInf, -kInf, kNaN}) {
    expect_same(kNaN, hoap2_sin(x));
    expect_same(kNaN, hoap2_cos(x));
  }
}

TEST(ScalarMath, Atan2OfSpecialValues) {
  const double values[] = {0.0, -0.0, 1.0, -1.0, kInf, -kInf, kNaN, kLeast, -kLeast, kLargest, -kLargest};
  for (double y : values) {
    for (double x : values) {
      SCOPED_TRACE(testing::Message() << y << " " << x);
      const double wanted = std::atan2(y, x);
      const double got = hoap2_atan2(y, x);
      EXPECT_EQ(std::isnan(wanted), std::isnan(got));
      if (std::isnan(wanted)) continue;
      EXPECT_EQ(std::signbit(wanted), std::signbit(got));
      EXPECT_LE(std::abs(got - wanted), 0x1p-52 * std::abs(wanted));  // 1 ulp of either
    }
  }
  expect_same(-kPi, hoap2_atan2(-0.0, -1.0));
  expect_same(kLeast, hoap2_atan2(kLeast, 1.0));
}

TEST(ScalarMath, HypotOfSpecialValues) {
  expect_same(5.0, hoap2_hypot(-3.0, 4.0));
  expect_same(kInf, hoap2_hypot(kNaN, -kInf));
  expect_same(kInf, hoap2_hypot(kInf, kNaN));
  expect_same(kNaN, hoap2_hypot(kNaN, 1.0));
  expect_same(0.0, hoap2_hypot(-0.0, 0.0));
  expect_same(kLeast, hoap2_hypot(0.0, -kLeast));
  expect_same(kLargest, hoap2_hypot(kLargest, 0.0));
  expect_same(kInf, hoap2_hypot(kLargest, kLargest));
  expect_same(5.0 * kLeast, hoap2_hypot(3.0 * kLeast, 4.0 * kLeast));
  expect_same(5e300, hoap2_hypot(3e300, 4e300));
}

TEST(ScalarMath, ExpOfSpecialValues) {
  expect_same(1.0, hoap2_exp(0.0));
  expect_same(1.0, hoap2_exp(-0.0));
  expect_same(kInf, hoap2_exp(kInf));
  expect_same(0.0, hoap2_exp(-kInf));
  expect_same(kNaN, hoap2_exp(kNaN));
  expect_same(kInf, hoap2_exp(709.7827128933841));   // the first beyond the largest number
  EXPECT_LT(hoap2_exp(709.782712893384), kInf);
  expect_same(kLeast, hoap2_exp(-745.1332191019411));
  expect_same(0.0, hoap2_exp(-745.2));
}

TEST(ScalarMath, SymmetriesHoldToTheBit) {
  uint64_t state = 1;
  for (int i = 0; i < 20000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double x = (static_cast<double>(state >> 11) * 0x1p-53 - 0.5) * 40.0;
    const double y = static_cast<double>(state & 0xffffffff) * 0x1p-30 - 2.0;
    expect_same(-hoap2_sin(x), hoap2_sin(-x));
    expect_same(hoap2_cos(x), hoap2_cos(-x));
    expect_same(-hoap2_atan2(y, x), hoap2_atan2(-y, x));
    expect_same(hoap2_hypot(x, y), hoap2_hypot(-y, x));
    EXPECT_NEAR(1.0, hoap2_sin(x) * hoap2_sin(x) + hoap2_cos(x) * hoap2_cos(x), 3e-16);
    EXPECT_NEAR(1.0, hoap2_exp(y) * hoap2_exp(-y), 5e-16);
  }
}

// FNV-1a over the bits of the results.
class Digest {
 public:
  void add(double x) {
    for (int i = 0; i < 8; ++i) value_ = (value_ ^ (bits(x) >> (8 * i) & 0xff)) * 1099511628211u;
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 14695981039346656037u;
};

// Golden: any machine, any compiler. A change of the functions changes it, and with it every recorded walk.
TEST(ScalarMath, BitsAreTheSameEverywhere) {
  Digest digest;
  uint64_t state = 7;
  for (int i = 0; i < 100000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double unit = static_cast<double>(state >> 11) * 0x1p-53;
    const double x = std::ldexp(unit - 0.5, i % 40 - 10), y = static_cast<double>(state & 0xffff) * 0x1p-12 - 8.0;
    digest.add(hoap2_sin(x));
    digest.add(hoap2_cos(x));
    digest.add(hoap2_atan2(y, x));
    digest.add(hoap2_hypot(x, y));
    digest.add(hoap2_exp(y));
  }
  EXPECT_EQ(13711210879127300958u, digest.value());
}

}  // namespace
