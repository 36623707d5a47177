#include "solver/bound_iteration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hoap2_sim {
namespace {

// An error this much above the smallest so far: the model of the past steps misleads.
constexpr double kWorse = 4.0;
constexpr double kDamping = 0.5;
constexpr double kRegularisation = 1e-14;  // of the squared lengths of the past steps

double dot(const double *a, const double *b, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void BoundIteration::start(int count) {
  count_ = count;
  kept_ = calls_ = 0;
  low_ = 0.0;
  high_ = error_before_[0] = std::numeric_limits<double>::infinity();
}

// A single bound has a bracket: g(0) >= 0, and an error that is negative closes it. Where
// the guess lies outside or the error shrinks slowly, it is halved: a steep or kinked g converges too.
double BoundIteration::within_bracket(double before, double error, double value) {
  (error > 0.0 ? low_ : high_) = before;
  if (std::isinf(high_)) return value;
  const bool inside = value > low_ && value < high_;
  const bool slow = std::fabs(error) > 0.5 * std::fabs(error_before_[0]);
  return inside && !slow ? value : 0.5 * (low_ + high_);
}

// With e = g(b) - b, and dE, dG the last differences of e and g: the next guess is
// g - dG c, where c makes |e - dE c| least (Walker and Ni, 2011). For one bound that is the
// secant method, which also finds fixed points that repel plain iteration.
void BoundIteration::next(const double *image, double *guess) {
  double error[kMaxContacts];
  for (int i = 0; i < count_; ++i) error[i] = image[i] - guess[i];
  const double size = std::sqrt(dot(error, error, count_));
  const bool worse = calls_ > 0 && size > kWorse * best_error_;
  best_error_ = calls_ == 0 ? size : std::min(size, best_error_);
  if (worse) {
    kept_ = 0;
  } else if (calls_ > 0) {
    const int slot = (calls_ - 1) % kDepth;
    for (int i = 0; i < count_; ++i) {
      error_step_[slot][i] = error[i] - error_before_[i];
      image_step_[slot][i] = image[i] - image_before_[i];
    }
    kept_ = std::min(kept_ + 1, kDepth);
  }
  Eigen::Matrix<double, kDepth, kDepth> gram = Eigen::Matrix<double, kDepth, kDepth>::Identity();
  Eigen::Matrix<double, kDepth, 1> right = Eigen::Matrix<double, kDepth, 1>::Zero();
  for (int k = 0; k < kept_; ++k) {
    const int a = (calls_ - 1 - k + kDepth) % kDepth;
    for (int l = 0; l < kept_; ++l) {
      gram(k, l) = dot(error_step_[a], error_step_[(calls_ - 1 - l + kDepth) % kDepth], count_);
    }
    gram(k, k) *= 1.0 + kRegularisation;
    right[k] = dot(error_step_[a], error, count_);
  }
  const Eigen::Matrix<double, kDepth, 1> weight = gram.ldlt().solve(right);
  for (int i = 0; i < count_; ++i) {
    double value = worse ? guess[i] + kDamping * error[i] : image[i];
    for (int k = 0; k < kept_; ++k) {
      value -= weight[k] * image_step_[(calls_ - 1 - k + kDepth) % kDepth][i];
    }
    if (count_ == 1) value = within_bracket(guess[0], error[0], value);
    image_before_[i] = image[i];
    error_before_[i] = error[i];
    guess[i] = std::max(0.0, value);
  }
  ++calls_;
}

}  // namespace hoap2_sim
