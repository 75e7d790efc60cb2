// What each recorded state must fulfil by itself.
#ifndef CONTACT_PATH_SRC_VERIFY_POINT_CHECKS_H_
#define CONTACT_PATH_SRC_VERIFY_POINT_CHECKS_H_

#include <cstddef>

#include "contact_path/path/increment.h"
#include "contact_path/verify/verify_path.h"
#include "verify/verified_stage.h"

namespace contact_path {

// Residuals, supports, gaps, contact states and recorded numbers of the increments of one stage.
class PointChecks {
 public:
  // All must outlive the checks.
  PointChecks(const VerifiedStage& stage, Findings* findings, Verification* result)
      : stage_(stage), findings_(*findings), result_(*result) {}

  // before: the last increment that has its state; null: there is none.
  void Check(const Increment* before, const Increment& increment);

 private:
  // What holds for inner states, too. in_one_piece: what happened since `before` is one arc of the path.
  void CheckState(const Increment& before, const Increment& at, bool in_one_piece, const Residuals& residuals);
  void CheckInner(const Increment& before, const Increment& increment);
  // Numbers of the increment that follow from its state. with_law: the residual of the friction law, too.
  void CheckRecorded(const Increment& increment, const Residuals& residuals, bool with_law);
  // Forces of supports and boundaries, and what elements and contacts bear.
  void CheckForces(const Increment& increment);
  void CheckSupports(const Increment& at);
  // Gap and state of a contact. slip: what the law of friction is about, over L. Tolerances: scaled.
  void CheckContact(std::size_t i, const ContactRecord& contact, const CheckedState& state, double slip,
                    double tolerance, double tolerance_of_slip);
  // Equilibrium across the surfaces and the laws of reactions where F is no measure of them.
  void CheckSoftContacts(const Increment& increment);
  // Where reactions are so small that residuals over F cannot tell: against what contacts have pushed with.
  void CheckPull(const Increment& at);

  const VerifiedStage& stage_;
  Findings& findings_;
  Verification& result_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_POINT_CHECKS_H_
