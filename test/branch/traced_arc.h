// An arc of a traced path, to look at its steps.
#ifndef CONTACT_PATH_TEST_BRANCH_TRACED_ARC_H_
#define CONTACT_PATH_TEST_BRANCH_TRACED_ARC_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/path/model.h"
#include "support/traced_path.h"

namespace contact_path {

// The arc of increment `index`, with the states of that increment, from the increment before.
class TracedArc {
 public:
  TracedArc(const TracedPath& path, std::size_t index)
      : model_(path.request.scene, CharacteristicScales(path.request.scene)), arc_(model_.structure, model_.contacts) {
    const PathPoint from = model_.FromIncrement(path.increments.at(index - 1)),
                    to = model_.FromIncrement(path.increments.at(index));
    arc_.SetStates(to.states, from);
    const Eigen::VectorXd start = arc_.system().Pack(from);
    end_ = arc_.system().Pack(to);
    EXPECT_TRUE(arc_.Derivatives(start, (end_ - start).head(motion()), &start_));
  }

  SmoothArc& arc() { return arc_; }
  const Model& model() const { return model_; }
  const CurvePoint& start() const { return start_; }
  const Eigen::VectorXd& end() const { return end_; }  // all unknowns at the increment
  Eigen::Index motion() const { return arc_.NumMotion(); }
  Eigen::VectorXd normal() const { return start_.first.head(motion()); }
  // In the units of the scene.
  double Load(const CurvePoint& point) const { return point.x[motion() - 1] * model_.scaling.load_factor; }

  // The point of the curve on the plane at the distance t from the start, which may be negative.
  CurvePoint At(double t) {
    CurvePoint point = start_;
    if (t == 0.0) return point;
    // In short steps: the curve may bend.
    const int steps = 1 + static_cast<int>(std::abs(t) / 0.01);
    for (int i = 0; i < steps; ++i) {
      const Correction correction = arc_.CorrectOnPlane(point.x + t / steps * start_.first, normal());
      EXPECT_TRUE(correction.converged) << t;
      point.x = correction.x;
    }
    const Eigen::VectorXd x = point.x;
    EXPECT_TRUE(arc_.Derivatives(x, normal(), &point));
    return point;
  }

  // Both ends by their distance along the tangent at the start of the arc.
  Step Between(double t0, double t1) {
    const CurvePoint start = At(t0);
    return MakeStep(start, At(t1), motion());
  }

 private:
  Model model_;
  SmoothArc arc_;
  CurvePoint start_;
  Eigen::VectorXd end_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_BRANCH_TRACED_ARC_H_
