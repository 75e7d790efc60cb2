#include "contact_path/equations/fixed_mode_frame.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "contact_path/linear/bordered_solver.h"

namespace contact_path {
namespace {

// Times the ports in a frame, against the dofs: more of them would make factors large.
constexpr double kMostInFrame = 2.0;

// framed: laws that may act, that couple nothing, ascending; tangent: its pattern counts. Unknowns: u, the forces of
// the ports of each law of `framed`, reactions of the prescribed components, s. Equations: equilibrium, the motions of
// these ports, prescribed components. Where a system stands in it is left open.
Frame FrameAround(const Structure& structure, const Laws& laws, const std::vector<std::size_t>& framed,
                  const Eigen::SparseMatrix<double>& tangent) {
  auto s = static_cast<int>(structure.NumDofs() + static_cast<Eigen::Index>(structure.PrescribedDofs().size()));
  for (const std::size_t i : framed) s += static_cast<int>(laws[i].NumPorts());
  std::vector<Eigen::Triplet<double>> entries;  // unknown, equation
  entries.reserve(static_cast<std::size_t>(tangent.nonZeros() + s) + 16 * framed.size());
  int place = 0;
  for (; place < structure.NumDofs(); ++place) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent, place); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), place);
    entries.emplace_back(s, place);
  }
  for (const std::size_t i : framed) {
    const Law& law = laws[i];
    const LawDofs dofs = law.Dofs(0);
    const int first = place;
    for (std::size_t p = 0; p < law.NumPorts(); ++p, ++place) {
      entries.emplace_back(place, place);
      if (law.Moves(p, dofs.size())) entries.emplace_back(s, place);
      for (std::size_t k = 0; k < dofs.size(); ++k) {
        if (!law.Moves(p, k)) continue;
        entries.emplace_back(dofs[k], place);
        entries.emplace_back(place, dofs[k]);
        entries.emplace_back(first, dofs[k]);  // a force that follows that of port 0
      }
    }
  }
  for (const PrescribedDof& prescribed : structure.PrescribedDofs()) {
    for (const int unknown : {prescribed.dof, place, s}) entries.emplace_back(unknown, place);
    entries.emplace_back(place++, prescribed.dof);
  }
  Eigen::SparseMatrix<double> pattern(s + 1, s);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Frame frame;
  frame.size = s + 1;
  frame.orderings = structure.SharedOrderings();
  frame.starts.assign(pattern.outerIndexPtr(), pattern.outerIndexPtr() + frame.size);
  frame.entries.assign(pattern.innerIndexPtr(), pattern.innerIndexPtr() + pattern.nonZeros());
  return frame;
}

}  // namespace

const Frame* FixedModeFrame::Get() {
  if (layout_.num_unknowns < kLargeSystem || layout_.num_equations + 1 != layout_.num_unknowns ||
      layout_.load_factor_fixed || !layout_.active.empty() || layout_.couples)
    return nullptr;
  if (placed_) return &frame_;
  if (frame_.size == 0 ||
      !std::includes(framed_.begin(), framed_.end(), laws_.Acting().begin(), laws_.Acting().end())) {
    framed_ = LawsToFrame();
    frame_ = Fits(framed_) ? FrameAround(structure_, laws_.laws(), framed_, structure_.TangentPattern()) : Frame();
  }
  if (frame_.size == 0) return nullptr;
  Place();
  return &frame_;
}

bool FixedModeFrame::Fits(const std::vector<std::size_t>& framed) const {
  std::size_t ports = 0;
  for (const std::size_t i : framed) ports += laws_[i].NumPorts();
  return kMostInFrame * static_cast<double>(ports) <= static_cast<double>(laws_.NumDofs());
}

// All laws that do not couple where they are few; otherwise those that act, and those that did before while they are
// few.
std::vector<std::size_t> FixedModeFrame::LawsToFrame() const {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < laws_.laws().size(); ++i)
    if (!laws_[i].Couples()) all.push_back(i);
  if (Fits(all)) return all;
  all.clear();
  std::set_union(framed_.begin(), framed_.end(), laws_.Acting().begin(), laws_.Acting().end(), std::back_inserter(all));
  return Fits(all) ? all : laws_.Acting();
}

void FixedModeFrame::Place() {
  const auto nd = static_cast<int>(laws_.NumDofs());
  frame_.unknowns.assign(static_cast<std::size_t>(layout_.num_unknowns), 0);
  frame_.equations.assign(static_cast<std::size_t>(layout_.num_equations), 0);
  for (int k = 0; k < nd; ++k)
    frame_.unknowns[static_cast<std::size_t>(k)] = frame_.equations[static_cast<std::size_t>(k)] = k;
  frame_.unknowns[static_cast<std::size_t>(nd)] = frame_.size - 1;
  int place = nd;
  auto motion = layout_.motions.begin();  // in the order of the laws, and of their ports
  for (const std::size_t i : framed_) {
    for (; motion != layout_.motions.end() && motion->motion.law == i; ++motion) {
      const int of_port = place + static_cast<int>(motion->motion.port);
      frame_.unknowns[static_cast<std::size_t>(laws_.UnknownOf(i, motion->motion.port))] = of_port;
      frame_.equations[static_cast<std::size_t>(motion->equation)] = of_port;
    }
    place += static_cast<int>(laws_[i].NumPorts());
  }
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k, ++place) {
    frame_.unknowns[static_cast<std::size_t>(layout_.first_support) + k] = place;
    frame_.equations[static_cast<std::size_t>(layout_.first_support_equation) + k] = place;
  }
  frame_.odd = (layout_.num_unknowns - 1 - laws_.NumDofs()) % 2 != 0;
  placed_ = true;
}

}  // namespace contact_path
