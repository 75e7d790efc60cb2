#include "contact_path/equations/fixed_mode_layout.h"

#include <algorithm>
#include <utility>

namespace contact_path {

FixedModeLayout::FixedModeLayout(const Structure& structure, const LawsInModes& laws, const ModeLimits& limits,
                                 std::vector<Limit> active_limits, bool fixed)
    : active(std::move(active_limits)), load_factor_fixed(fixed), first_support(laws.NumUnknowns()) {
  const auto supports = static_cast<Eigen::Index>(structure.PrescribedDofs().size());
  num_unknowns = first_support + supports;
  Eigen::Index next = structure.NumDofs();
  for (const std::size_t i : laws.Acting())
    for (std::size_t p = 0; p < laws[i].NumPorts(); ++p)
      if (const PortRule& port = laws.StateOf(i).ports[p]; port.Holds())
        motions.push_back({{i, p},
                           next++,
                           port.compliance,
                           laws.UnknownOf(i, p),
                           laws[i].Elastic() ? 0.0 : std::max(port.compliance, laws[i].ToldBy())});
  first_support_equation = next;
  next += supports;
  first_active_equation = next;
  for (const Limit& limit : active) {
    const LimitRule& rule = limits.RuleOf(limit);
    const auto i = static_cast<std::size_t>(limit.law);
    if (rule.compliance != 0.0)  // the port follows the first one
      motions.push_back({limits.MotionOf(limit), next,
                         rule.sign * rule.compliance * laws.StateOf(i).ports[rule.port].ratio, laws.UnknownOf(i, 0)});
    else if (!rule.OfForces())
      motions.push_back({limits.MotionOf(limit), next});
    ++next;
  }
  num_equations = next + (load_factor_fixed ? 1 : 0);
  const auto some = [&](auto has) {
    return std::any_of(motions.begin(), motions.end(),
                       [&](const MotionEquation& of) { return has(laws[of.motion.law]); });
  };
  curved = some([](const Law& law) { return law.Curved(); });
  couples = some([](const Law& law) { return law.Couples(); });
  gives = some([](const Law& law) { return law.Compliant() && !law.Elastic(); });
}

}  // namespace contact_path
