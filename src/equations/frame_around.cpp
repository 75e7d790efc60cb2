#include "contact_path/equations/frame_around.h"

#include <algorithm>
#include <utility>

namespace contact_path {

Frame FrameAround(const Structure& structure, const ContactPairs& contacts, const std::vector<std::size_t>& framed,
                  const Eigen::SparseMatrix<double>& tangent) {
  const auto nd = static_cast<int>(structure.NumDofs()), count = static_cast<int>(framed.size());
  const int first_support = nd + 2 * count;
  const int s = first_support + static_cast<int>(structure.PrescribedDofs().size());
  std::vector<std::pair<int, int>> forces;  // dof, unknown
  for (int i = 0; i < count; ++i) {
    const ContactPair& pair = *contacts[framed[static_cast<std::size_t>(i)]];
    const PairDofs dofs = pair.Dofs(0);
    for (std::size_t k = 0; k < dofs.size(); ++k) {
      // Slip makes both components of r_n.
      if (pair.MovesGap(k) || pair.MovesXi(k)) forces.emplace_back(dofs[k], nd + 2 * i);
      if (pair.MovesXi(k)) forces.emplace_back(dofs[k], nd + 2 * i + 1);
    }
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
  for (int i = 0; i < count; ++i) {
    const ContactPair& pair = *contacts[framed[static_cast<std::size_t>(i)]];
    const PairDofs dofs = pair.Dofs(0);
    const std::size_t m = dofs.size();
    for (const bool gap : {true, false}) {
      for (std::size_t k = 0; k < m; ++k)
        if (gap ? pair.MovesGap(k) : pair.MovesXi(k)) entries.push_back(dofs[k]);
      entries.push_back(nd + 2 * i + (gap ? 0 : 1));
      if (gap ? pair.MovesGap(m) : pair.MovesXi(m)) entries.push_back(s);
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
