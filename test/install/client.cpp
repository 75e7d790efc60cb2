// A user's own program on the installed library: traces the scene file argv[1] and prints the number of increments.
#include <iostream>

#include "contact_path/path/trace.h"
#include "contact_path/scene/read_scene.h"

int main(int, char** argv) {
  int increments = 0;
  contact_path::TraceControl control;
  control.on_increment = [&increments](const contact_path::Increment&) { ++increments; };
  const contact_path::TraceResult result = contact_path::Trace(contact_path::ReadTraceRequestFile(argv[1]), control);
  std::cout << increments << ' ' << contact_path::ToString(result.reason) << '\n';
}
