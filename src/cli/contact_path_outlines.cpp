// contact_path_outlines SCENE.yaml: writes points along the curved obstacles of a scene as CSV to standard output.
#include <cmath>
#include <iostream>
#include <limits>
#include <locale>
#include <memory>

#include "cli/scene_program.h"
#include "contact_path/geometry/outline.h"
#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

constexpr OutlineSteps kSteps = {32, M_PI / 360.0};

void WriteOutlines(const Scene& scene, std::ostream& out) {
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "obstacle,closed,x,y,nx,ny,xi\n";
  for (const Obstacle& obstacle : scene.obstacles) {
    const std::unique_ptr<const Surface> surface = MakeSurface(obstacle);
    if (surface->Flat()) continue;
    for (const auto& [place, normal, xi] : Outline(*surface, kSteps)) {
      out << obstacle.name << ',' << surface->Closed() << ',' << place.x() << ',' << place.y() << ',' << normal.x()
          << ',' << normal.y() << ',' << xi << '\n';
    }
  }
  out.flush();
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  return contact_path::RunOnScene(
      "contact_path_outlines",
      "Writes points along the curved obstacles of a scene, where they are at the start, as CSV to standard output.",
      "/dev/stdin", argc, argv,
      [](const contact_path::TraceRequest& request) { contact_path::WriteOutlines(request.scene, std::cout); });
}
