// Where a fixed-mode system stands among those of other modes.
#include <algorithm>
#include <iterator>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/equations/frame_around.h"
#include "contact_path/linear/bordered_solver.h"

namespace contact_path {
namespace {

// Times the ports in a frame, against the dofs: more of them would make factors large.
constexpr double kMostInFrame = 2.0;

}  // namespace

const Frame* FixedModeSystem::InFrame() {
  if (num_unknowns_ < kLargeSystem || num_equations_ + 1 != num_unknowns_ || load_factor_fixed_ || !active_.empty() ||
      couples_)
    return nullptr;
  if (placed_) return &frame_;
  if (frame_.size == 0 || !std::includes(framed_.begin(), framed_.end(), acting_.begin(), acting_.end())) {
    framed_ = LawsToFrame();
    frame_ = FitFrame(framed_) ? FrameAround(structure_, laws_, framed_, tangent_) : Frame();
  }
  if (frame_.size == 0) return nullptr;
  PlaceInFrame();
  return &frame_;
}

bool FixedModeSystem::FitFrame(const std::vector<std::size_t>& framed) const {
  std::size_t ports = 0;
  for (const std::size_t i : framed) ports += laws_[i].NumPorts();
  return kMostInFrame * static_cast<double>(ports) <= static_cast<double>(NumDofs());
}

// All laws that do not couple where they are few; otherwise those that act, and those that did before while they are
// few.
std::vector<std::size_t> FixedModeSystem::LawsToFrame() const {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (!laws_[i].Couples()) all.push_back(i);
  if (FitFrame(all)) return all;
  all.clear();
  std::set_union(framed_.begin(), framed_.end(), acting_.begin(), acting_.end(), std::back_inserter(all));
  return FitFrame(all) ? all : acting_;
}

void FixedModeSystem::PlaceInFrame() {
  const auto nd = static_cast<int>(NumDofs());
  frame_.unknowns.assign(static_cast<std::size_t>(num_unknowns_), 0);
  frame_.equations.assign(static_cast<std::size_t>(num_equations_), 0);
  for (int k = 0; k < nd; ++k)
    frame_.unknowns[static_cast<std::size_t>(k)] = frame_.equations[static_cast<std::size_t>(k)] = k;
  frame_.unknowns[static_cast<std::size_t>(nd)] = frame_.size - 1;
  int place = nd;
  auto motion = motions_.begin();  // in the order of the laws, and of their ports
  for (const std::size_t i : framed_) {
    for (; motion != motions_.end() && motion->motion.law == i; ++motion) {
      const int of_port = place + static_cast<int>(motion->motion.port);
      frame_.unknowns[static_cast<std::size_t>(UnknownOf(i, motion->motion.port))] = of_port;
      frame_.equations[static_cast<std::size_t>(motion->equation)] = of_port;
    }
    place += static_cast<int>(laws_[i].NumPorts());
  }
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k, ++place) {
    frame_.unknowns[static_cast<std::size_t>(first_support_) + k] = place;
    frame_.equations[static_cast<std::size_t>(first_support_equation_) + k] = place;
  }
  frame_.odd = (num_unknowns_ - 1 - NumDofs()) % 2 != 0;
  placed_ = true;
}

}  // namespace contact_path
