// contact_path_outlines SCENE.yaml: writes points along the curved obstacles of a scene as CSV to standard output.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <limits>
#include <locale>
#include <memory>
#include <string>

#include "contact_path/geometry/outline.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

constexpr OutlineSteps kSteps = {32, 3.141592653589793 / 360.0};

void WriteOutlines(const Scene& scene, std::ostream& out) {
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  out << "obstacle,closed,x,y,nx,ny,xi\n";
  for (const Obstacle& obstacle : scene.obstacles) {
    const std::unique_ptr<const Surface> surface = MakeSurface(obstacle);
    if (surface->Flat()) continue;
    for (const auto& [place, normal, xi] : Outline(*surface, surface->Range(), kSteps)) {
      out << obstacle.name << ',' << surface->Closed() << ',' << place.x() << ',' << place.y() << ',' << normal.x()
          << ',' << normal.y() << ',' << xi << '\n';
    }
  }
  out.flush();
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  CLI::App app(
      "Writes points along the curved obstacles of a scene, where they are at the start, as CSV to standard output.",
      "contact_path_outlines");
  std::string scene_file = "/dev/stdin";
  app.add_option("SCENE", scene_file, "Scene file")->capture_default_str();
  try {
    app.parse(argc, argv);
    contact_path::WriteOutlines(contact_path::ReadTraceRequestFile(scene_file).scene, std::cout);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "contact_path_outlines: " << error.what() << '\n';
    return 2;
  }
  return std::cout ? 0 : 1;
}
