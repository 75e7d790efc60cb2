// Numbers that look random and are the same in every run and on every system.
#ifndef CONTACT_PATH_TEST_SUPPORT_RANDOM_H_
#define CONTACT_PATH_TEST_SUPPORT_RANDOM_H_

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace contact_path {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  // Uniform in [lower, upper).
  double Number(double lower, double upper) { return lower + (upper - lower) * std::ldexp(engine_(), -32); }
  Eigen::VectorXd Vector(Eigen::Index size, double lower, double upper) {
    Eigen::VectorXd vector(size);
    for (Eigen::Index i = 0; i < size; ++i) vector[i] = Number(lower, upper);
    return vector;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_RANDOM_H_
