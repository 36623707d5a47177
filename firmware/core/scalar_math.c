#include "core/scalar_math.h"

#include "core/angle_reduction.h"
#include "core/double_double.h"

/* Coefficients: interpolation at the Chebyshev nodes of each interval, worked out with 60 digits. */

static double polynomial(double z, const double coefficients[], int count) {
  double sum = coefficients[count - 1];
  for (int i = count - 2; i >= 0; --i) sum = coefficients[i] + z * sum;
  return sum;
}

static int is_finite(double x) { return (hoap2_bits_of(x) >> 52 & 0x7ff) != 0x7ff; }

/* ---- sine and cosine */

/* (sin(r)/r - 1) / r^2 and (cos(r) - 1 + r^2/2) / r^4 over z = r^2, |r| <= pi/4 */
static const double kSin[] = {-0x1.5555555555555p-3, 0x1.1111111110bb1p-7,   -0x1.a01a019e8357dp-13,
                              0x1.71de37961e4c6p-19, -0x1.ae600a926c89ap-26, 0x1.5e0af186af739p-33};
static const double kCos[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16966p-10, 0x1.a01a019f4e867p-16,
                              -0x1.27e4fa17a41b3p-22, 0x1.1eeb68b109138p-29,  -0x1.907d7aebd3bccp-37};

static double sin_near_0(hoap2_dd_t r) {
  const double z = r.hi * r.hi;
  return r.hi + (r.hi * z * polynomial(z, kSin, 6) + r.lo * (1.0 - 0.5 * z));
}

static double cos_near_0(hoap2_dd_t r) {
  const double z = r.hi * r.hi;
  const hoap2_dd_t head = hoap2_dd_sum(1.0, -0.5 * z);
  return head.hi + (head.lo + (z * z * polynomial(z, kCos, 6) - r.hi * r.lo));
}

/* sin(x + turns pi/2) */
static double sin_turned(double x, int turns) {
  int quadrant;
  const hoap2_dd_t r = hoap2_reduce_angle(x, &quadrant);
  quadrant += turns;
  const double value = quadrant & 1 ? cos_near_0(r) : sin_near_0(r);
  return quadrant & 2 ? -value : value;
}

double hoap2_sin(double x) {
  if (!is_finite(x)) return x - x;
  if (hoap2_exponent_of(x) < -27) return x;
  return sin_turned(x, 0);
}

double hoap2_cos(double x) { return is_finite(x) ? sin_turned(x, 1) : x - x; }

/* ---- atan2 */

enum { ATAN_STEPS = 8 };
/* atan(k/8) */
static const hoap2_dd_t kAtanOf[ATAN_STEPS + 1] = {
    {0.0, 0.0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
/* (atan(u)/u - 1) / u^2 over u^2, |u| <= 1/16 */
static const double kAtan[] = {-0x1.5555555555553p-2, 0x1.999999998a25ep-3, -0x1.249248a94e1b2p-3,
                               0x1.c719c125bffb4p-4, -0x1.714b37861080ap-4};
static const hoap2_dd_t kPi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
static const hoap2_dd_t kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/* a + factor * b, with one rounding or so. */
static hoap2_dd_t multiply_add(double a, double factor, double b) {
  const hoap2_dd_t product = hoap2_dd_product(factor, b);
  const hoap2_dd_t sum = hoap2_dd_sum(a, product.hi);
  return hoap2_dd_sum(sum.hi, sum.lo + product.lo);
}

/* atan(y/x) for 0 <= y <= x, x in [1, 2): atan(c) + atan((y - c x) / (x + c y)) with c = k/8 nearest to y/x. */
static hoap2_dd_t atan_of_ratio(double y, double x) {
  const int k = (int)(ATAN_STEPS * (y / x) + 0.5);
  const double c = (double)k / ATAN_STEPS;
  const hoap2_dd_t above = multiply_add(y, -c, x);
  const hoap2_dd_t below = multiply_add(x, c, y);
  const double u = above.hi / below.hi;
  const hoap2_dd_t back = hoap2_dd_product(u, below.hi);
  const double rest = (((above.hi - back.hi) - back.lo) + above.lo - u * below.lo) / below.hi;
  const double z = u * u;
  const hoap2_dd_t sum = hoap2_dd_sum(kAtanOf[k].hi, u);
  return hoap2_dd_sum(sum.hi, sum.lo + (kAtanOf[k].lo + (rest + u * z * polynomial(z, kAtan, 5))));
}

/* base + sign * angle */
static hoap2_dd_t turned(hoap2_dd_t base, double sign, hoap2_dd_t angle) {
  const hoap2_dd_t sum = hoap2_dd_sum(base.hi, sign * angle.hi);
  return hoap2_dd_sum(sum.hi, sum.lo + (base.lo + sign * angle.lo));
}

/* atan2 for finite y, x >= 0 in absolute value, not both 0. */
static double first_quadrant(double y, double x, int is_left) {
  const int steep = y > x;
  const double large = steep ? y : x, small = steep ? x : y;
  /* A power of 2, in two steps, brings the larger one to [1, 2); subnormal numbers are lifted first. */
  const double lift = hoap2_exponent_of(large) < -1022 ? 0x1p+100 : 1.0;
  const int down = -hoap2_exponent_of(large * lift);
  const double half = hoap2_power_of_2(down / 2), other = hoap2_power_of_2(down - down / 2);
  const double l = large * lift * half * other, s = small * lift * half * other;
  if (!steep && !is_left && s < 0x1p-60) return small / large;
  hoap2_dd_t angle = {s, 0.0};
  if (s >= 0x1p-200) angle = atan_of_ratio(s, l);
  if (steep) angle = turned(kHalfPi, -1.0, angle);
  if (is_left) angle = turned(kPi, -1.0, angle);
  return angle.hi;
}

double hoap2_atan2(double y, double x) {
  if (x != x || y != y) return x + y;
  const int is_left = (int)(hoap2_bits_of(x) >> 63), is_below = (int)(hoap2_bits_of(y) >> 63);
  double large_y = is_below ? -y : y, large_x = is_left ? -x : x;
  if (!is_finite(x) || !is_finite(y)) { /* the same direction with finite numbers */
    const int both = !is_finite(x) && !is_finite(y);
    large_y = both || !is_finite(y) ? 1.0 : 0.0;
    large_x = both || !is_finite(x) ? 1.0 : 0.0;
  }
  double angle;
  if (large_y == 0.0) {
    angle = is_left ? kPi.hi : 0.0;
  } else {
    angle = first_quadrant(large_y, large_x, is_left);
  }
  return is_below ? -angle : angle;
}

/* ---- hypot */

double hoap2_hypot(double x, double y) {
  x = hoap2_of_bits(hoap2_bits_of(x) & 0x7fffffffffffffffu);
  y = hoap2_of_bits(hoap2_bits_of(y) & 0x7fffffffffffffffu);
  if (!is_finite(x) || !is_finite(y)) {
    if (x == x && !is_finite(x)) return x; /* an infinite side decides, whatever the other one is */
    if (y == y && !is_finite(y)) return y;
    return x + y;
  }
  const double large = x > y ? x : y, small = x > y ? y : x;
  if (small == 0.0 || large * 0x1p-60 > small) return large + small;
  const double scale = large > 0x1p+500 ? 0x1p-600 : (large < 0x1p-500 ? 0x1p+600 : 1.0);
  const hoap2_dd_t a = hoap2_dd_product(large * scale, large * scale);
  const hoap2_dd_t b = hoap2_dd_product(small * scale, small * scale);
  const hoap2_dd_t sum = hoap2_dd_sum(a.hi, b.hi);
  const double root = sqrt(sum.hi);
  const hoap2_dd_t square = hoap2_dd_product(root, root);
  const double rest = ((sum.hi - square.hi) - square.lo) + (sum.lo + (a.lo + b.lo));
  return (root + 0.5 * rest / root) / scale;
}

/* ---- exp */

/* (exp(r) - 1 - r) / r^2, |r| <= ln(2)/2 */
static const double kExp[] = {0x1.0000000000001p-1,  0x1.5555555555556p-3,  0x1.5555555553d37p-5, 0x1.11111111109a6p-7,
                              0x1.6c16c1789d1d7p-10, 0x1.a01a01a7cebcdp-13, 0x1.a019b8ca26fcfp-16,
                              0x1.71de0d85293b8p-19, 0x1.2891d4ffbb0f9p-22, 0x1.af390ba7e6f47p-26};
static const double kInverseLn2 = 0x1.71547652b82fep+0;
static const double kLn2_hi = 0x1.62e42feep-1, kLn2_lo = 0x1.a39ef35793c76p-33;

double hoap2_exp(double x) {
  if (x != x) return x;
  if (x > 709.79) return HUGE_VAL;
  if (x < -745.14) return 0.0;
  const double k = floor(x * kInverseLn2 + 0.5);
  const hoap2_dd_t r = hoap2_dd_sum(x - k * kLn2_hi, -(k * kLn2_lo));
  const double tail = r.hi * r.hi * polynomial(r.hi, kExp, 10) + r.lo * (1.0 + r.hi);
  const hoap2_dd_t head = hoap2_dd_sum(1.0, r.hi);
  const double value = head.hi + (head.lo + tail);
  const int half = (int)k / 2; /* in two steps: 2^k alone may be out of range */
  return value * hoap2_power_of_2(half) * hoap2_power_of_2((int)k - half);
}
