// The increments of Kanno & Martins 2005, predicted and certified: direction first, length second.
//
// Where branches part, the problem of the direction is solved: of the solutions of the rate complementarity problem the
// one that (4) prefers, least -dissipation rate first, smallest turn second. With the contact states that it tells, the
// minimiser of (9) is the point of one smooth curve that is nearest to from + S d; where all inequalities of these
// states hold there, it is strongly stationary for (9). An inequality that fails is a corner: the increment ends there,
// exactly. Ipopt solves (10) where no direction is found otherwise.
#ifndef CONTACT_PATH_PATH_CERTIFIED_METHOD_H_
#define CONTACT_PATH_PATH_CERTIFIED_METHOD_H_

#include <functional>
#include <optional>
#include <string>

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/mpec/arc_increment.h"
#include "contact_path/path/departure.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

class CertifiedMethod : public PathMethod {
 public:
  // model must outlive the method. cancelled may be empty.
  CertifiedMethod(const Model& model, const MpecOptions& options, std::function<bool()> cancelled);

  std::optional<EndReason> Start(const PathPoint& from, EventRecord* branches, std::string* message) override;
  bool Resume(const ResumePoint& at) override;
  Advance Next(const PathPoint& from) override;
  int NumEvents() const override { return events_; }
  std::string Remark() const override;

 private:
  Eigen::Index LoadFactor() const { return arc_.NumMotion() - 1; }  // its place among the unknowns
  // The increment of the wanted length, or of a part of it, that can be certified. Nothing: none can; *message says
  // why.
  struct Certified {
    ArcIncrement increment;
    PathPoint point;
    Residuals residuals;
    double tried = 0.0;
    int rejected = 0;
  };
  std::optional<Certified> Certify(const PathPoint& from, EndReason* reason, std::string* message);
  // An increment in which nothing moves: the reactions with which the branch begins.
  Advance ChangeReactions(const PathPoint& from);
  // Sets out from the corner where the increment ends. Nothing: done. Otherwise the path ends, with *message.
  std::optional<EndReason> LeaveCorner(const PathPoint& from, const Certified& at, AcceptedPoint* accepted,
                                       std::string* message);
  // Where the path comes back to an earlier increment: its number, and the increment ends there.
  std::optional<int> EndAtReturn(const PathPoint& from, Certified* at);
  AcceptedPoint PointOf(const PathPoint& point, const Residuals& residuals) const;

  const Model& model_;
  MpecOptions options_;
  std::function<bool()> cancelled_;
  Departure departure_;
  SmoothArc arc_;
  CurvePoint current_;
  double step_length_;
  int events_;                // passed so far
  int corners_in_place_ = 0;  // passed without moving
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_CERTIFIED_METHOD_H_
