// contact_path_lattice: writes the scene of a lattice truss of a wanted size to standard output.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "contact_path/scene/lattice.h"
#include "contact_path/scene/write_scene.h"

int main(int argc, char** argv) {
  CLI::App app("Writes the scene of a lattice truss with contact and friction to standard output.",
               "contact_path_lattice");
  contact_path::LatticeOptions options;
  std::string kind = "column";
  app.add_option("KIND", kind, "column (on a rough floor), arch, wall or block (above one)")
      ->check(CLI::IsMember({"column", "arch", "wall", "block"}))
      ->capture_default_str();
  app.add_option("--columns", options.columns, "Cells along the edge that may touch")->capture_default_str();
  app.add_option("--rows", options.rows, "Cells across")->capture_default_str();
  app.add_option("--contacts", options.contacts, "Candidates along that edge; 0 = all its free nodes")
      ->capture_default_str();
  app.add_option("--far-candidates", options.far_candidates, "Candidates out of reach")->capture_default_str();
  app.add_option("--friction", options.friction, "Of the floor")->capture_default_str();
  try {
    app.parse(argc, argv);
    options.kind = *contact_path::ParseLatticeKind(kind);
    std::cout << contact_path::WriteTraceRequest(contact_path::LatticeRequest(options)) << std::flush;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "contact_path_lattice: " << error.what() << '\n';
    return 2;
  }
  return std::cout ? 0 : 1;
}
