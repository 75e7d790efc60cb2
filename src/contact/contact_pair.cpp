#include "contact_path/contact/contact_pair.h"

#include <cmath>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {

int ContactPair::PatchOfTouching(int patch) const {
  if (!HasPatches() || HasPatch(patch)) return patch;
  return HasPatch(patch + 1) ? patch + 1 : patch - 1;
}

double ContactPair::Xi(const Eigen::VectorXd& u, double s, int patch) const {
  return Law::Motion(kTangent, u, s, patch, {});
}

double ContactPair::FootXi(const Eigen::VectorXd& u, double s, int patch) const {
  return Law::Motion(FootPort(), u, s, patch, {});
}

double ContactPair::Motion(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                           const PortReals& reference) const {
  return port == kNormal ? Gap(u, s, patch) - reference[kNormal] : Law::Motion(port, u, s, patch, reference);
}

double ContactPair::SlipReference(const Eigen::VectorXd& u, double s, int patch) const {
  if (!Holonomic()) return Xi(u, s, patch);
  const double origin = *surface_traits_.slip_origin, round = surface_traits_.round;
  if (!(round > 0.0)) return origin;
  return origin + round * std::round((Xi(u, s, patch) - origin) / round);
}

double ContactPair::Slipped(const Eigen::VectorXd& u, double s, int patch) const {
  return Holonomic() ? Xi(u, s, patch) - SlipReference(u, s, patch) : 0.0;
}

Laws LawsOf(const ContactPairs& contacts) {
  Laws laws;
  for (const auto& contact : contacts) laws.Add(contact.get());
  return laws;
}

}  // namespace contact_path
