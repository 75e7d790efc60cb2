#include "contact_path/equations/fixed_mode_frame.h"

#include <algorithm>
#include <iterator>
#include <utility>

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
  const auto nd = static_cast<int>(structure.NumDofs());
  int first_support = nd;
  for (const std::size_t i : framed) first_support += static_cast<int>(laws[i].NumPorts());
  const int s = first_support + static_cast<int>(structure.PrescribedDofs().size());
  std::vector<std::pair<int, int>> forces;  // dof, unknown
  int place = nd;
  for (const std::size_t i : framed) {
    const Law& law = laws[i];
    const LawDofs dofs = law.Dofs(0);
    for (std::size_t k = 0; k < dofs.size(); ++k) {
      bool moves = false;  // forces that follow that of port 0 are in its column
      for (std::size_t p = law.NumPorts(); p-- > 0;) {
        moves = moves || law.Moves(p, k);
        if (p == 0 ? moves : law.Moves(p, k)) forces.emplace_back(dofs[k], place + static_cast<int>(p));
      }
    }
    place += static_cast<int>(law.NumPorts());
  }
  int support = first_support;
  for (const PrescribedDof& prescribed : structure.PrescribedDofs()) forces.emplace_back(prescribed.dof, support++);
  std::sort(forces.begin(), forces.end());

  Frame frame;
  std::vector<int>&starts = frame.starts, &entries = frame.entries;
  frame.size = s + 1;
  frame.orderings = structure.SharedOrderings();
  starts.reserve(static_cast<std::size_t>(frame.size));
  starts.push_back(0);
  entries.reserve(static_cast<std::size_t>(tangent.nonZeros() + nd) + 8 * framed.size() + forces.size());
  const auto end_equation = [&] { starts.push_back(static_cast<int>(entries.size())); };
  auto force = forces.begin();
  for (int column = 0; column < nd; ++column) {
    entries.insert(entries.end(), tangent.innerIndexPtr() + tangent.outerIndexPtr()[column],
                   tangent.innerIndexPtr() + tangent.outerIndexPtr()[column + 1]);
    for (; force != forces.end() && force->first == column; ++force) entries.push_back(force->second);
    entries.push_back(s);
    end_equation();
  }
  place = nd;
  for (const std::size_t i : framed) {
    const Law& law = laws[i];
    const LawDofs dofs = law.Dofs(0);
    for (std::size_t p = 0; p < law.NumPorts(); ++p) {
      for (std::size_t k = 0; k < dofs.size(); ++k)
        if (law.Moves(p, k)) entries.push_back(dofs[k]);
      entries.push_back(place++);
      if (law.Moves(p, dofs.size())) entries.push_back(s);
      end_equation();
    }
  }
  support = first_support;
  for (const PrescribedDof& prescribed : structure.PrescribedDofs()) {
    entries.insert(entries.end(), {prescribed.dof, support++, s});
    end_equation();
  }
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
