#include "contact_path/path/diagnosis.h"

#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string_view>
#include <unordered_map>

namespace contact_path {
namespace {

constexpr double kNearlyNothing = 1e-2;  // of the initial length

}  // namespace

std::string CollapsedBar(const Scene& scene, const std::vector<double>& positions) {
  std::unordered_map<std::string_view, std::size_t> number;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) number[scene.nodes[i].name] = i;
  double smallest = kNearlyNothing;
  std::string text;
  for (std::size_t i = 0; i < scene.bars.size(); ++i) {
    const std::size_t a = number.at(scene.bars[i].nodes[0]), b = number.at(scene.bars[i].nodes[1]);
    const double length = std::hypot(positions[2 * b] - positions[2 * a], positions[2 * b + 1] - positions[2 * a + 1]);
    const double initial = std::hypot(scene.nodes[b].x - scene.nodes[a].x, scene.nodes[b].y - scene.nodes[a].y);
    if (!(length < smallest * initial)) continue;
    smallest = length / initial;
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(2);
    out << "bar " << i << " (" << scene.bars[i].nodes[0] << ", " << scene.bars[i].nodes[1] << ") has shrunk to "
        << smallest << " of its initial length";
    text = out.str();
  }
  return text;
}

}  // namespace contact_path
