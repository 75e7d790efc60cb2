#include "contact_path/equations/frame_around.h"

#include <algorithm>
#include <utility>

namespace contact_path {

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

}  // namespace contact_path
