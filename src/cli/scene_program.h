// A program that reads one scene file and writes to standard output.
#ifndef CONTACT_PATH_SRC_CLI_SCENE_PROGRAM_H_
#define CONTACT_PATH_SRC_CLI_SCENE_PROGRAM_H_

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "contact_path/scene/read_scene.h"

namespace contact_path {

// The exit status: 2 for bad usage, an invalid scene, and what `write(request)` throws, which standard error tells;
// 1 where standard output cannot be written. default_scene: empty where the scene has to be given.
template <typename Write>
int RunOnScene(const std::string& program, const std::string& description, const std::string& default_scene, int argc,
               char** argv, Write write) {
  CLI::App app(description, program);
  std::string scene_file = default_scene;
  CLI::Option* const option = app.add_option("SCENE", scene_file, "Scene file");
  if (default_scene.empty())
    option->required();
  else
    option->capture_default_str();
  try {
    app.parse(argc, argv);
    write(ReadTraceRequestFile(scene_file));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return 2;
  }
  return std::cout ? 0 : 1;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CLI_SCENE_PROGRAM_H_
