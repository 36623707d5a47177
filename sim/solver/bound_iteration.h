// Fixed points of many coupled friction bounds: Anderson's acceleration of b -> g(b).
#ifndef HOAP2_SIM_SOLVER_BOUND_ITERATION_H
#define HOAP2_SIM_SOLVER_BOUND_ITERATION_H

#include "terrain/contact.h"

namespace hoap2_sim {

class BoundIteration {
 public:
  void start(int count);
  // Takes the image g of b and puts the next guess into b, never below 0. Sizes: count.
  void next(const double *image, double *guess);

 private:
  static constexpr int kDepth = 6;

  double within_bracket(double before, double error, double value);

  int count_ = 0, kept_ = 0, calls_ = 0;
  double best_error_ = 0.0;
  double low_ = 0.0, high_ = 0.0;  // of a single bound: its error is positive, negative
  double image_before_[kMaxContacts], error_before_[kMaxContacts];
  double image_step_[kDepth][kMaxContacts], error_step_[kDepth][kMaxContacts];
};

}  // namespace hoap2_sim
#endif
