// The text of a request, of which tests change lines.
#ifndef CONTACT_PATH_TEST_SCENE_BASE_TEXT_H_
#define CONTACT_PATH_TEST_SCENE_BASE_TEXT_H_

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/validate.h"

namespace contact_path {

// A request with every key. Tests name its lines by the number, from 1.
inline const std::vector<std::string> kLines = {
    "scene:",                                                       // 1
    "  name: base",                                                 // 2
    "  nodes:",                                                     // 3
    "  - {name: a, x: 0.0, y: 5.0, fixed_x: true, fixed_y: true}",  // 4
    "  - name: b",                                                  // 5
    "    x: -5.0",                                                  // 6
    "    y: 0",                                                     // 7
    "    fixed_x: false",                                           // 8
    "    fixed_y: 0",                                               // 9
    "  - {name: c, x: -6.0, y: 0.0}",                               // 10
    "  bars:",                                                      // 11
    "  - nodes: [a, b]",                                            // 12
    "    EA: 14.0",                                                 // 13
    "    rest_length: 7.0",                                         // 14
    "    strain: logarithmic",                                      // 15
    "  superelements:",                                             // 16
    "  - nodes: [b,",                                               // 17
    "            c]",                                               // 18
    "    stiffness: [2.0, 0.0, -2.0, 0.0,",                         // 19
    "                0.0, 1.0, 0.0, -1.0,",                         // 20
    "                -2.0, 0.0, 2.0, 0.0,",                         // 21
    "                0.0, -1.0, 0.0, 1.0]",                         // 22
    "  loads:",                                                     // 23
    "  - node: b",                                                  // 24
    "    fx: 1.5",                                                  // 25
    "    fy: 0.25",                                                 // 26
    "    constant: false",                                          // 27
    "  - {node: b, fy: -1.0, constant: true}",                      // 28
    "  obstacles:",                                                 // 29
    "  - name: floor",                                              // 30
    "    shape: half_plane",                                        // 31
    "    px: 1.0",                                                  // 32
    "    py: -0.5",                                                 // 33
    "    nx: 0.0",                                                  // 34
    "    ny: 2.0",                                                  // 35
    "    friction: 0.3",                                            // 36
    "  contacts:",                                                  // 37
    "  - node: b",                                                  // 38
    "    obstacle: floor",                                          // 39
    "  - {node: c, obstacle: floor}",                               // 40
    "options:",                                                     // 41
    "  method: mpec",                                               // 42
    "  accuracy: accurate",                                         // 43
    "  direction: -1.0",                                            // 44
    "  step: 0.125",                                                // 45
    "  max_increments: 12",                                         // 46
    "  stop:",                                                      // 47
    "  - quantity: b.x",                                            // 48
    "    when: \">\"",                                              // 49
    "    value: 4.95",                                              // 50
    "  full_state_every: 5",                                        // 51
};

// The base with some lines replaced, by number. Choices of branches want the method branch.
inline std::string BaseWith(std::map<std::size_t, std::string> replaced) {
  for (const auto& [number, line] : replaced)
    if (line.find("branch_choices") != line.npos) replaced.emplace(42, "  method: branch");
  std::string text;
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    const auto other = replaced.find(i + 1);
    text += (other == replaced.end() ? kLines[i] : other->second) + "\n";
  }
  return text;
}

// Of a text with the name file.yaml.
inline std::vector<Violation> ViolationsOf(const std::string& text) {
  try {
    ReadTraceRequest(text, "file.yaml");
  } catch (const InvalidRequest& error) {
    return error.violations();
  }
  return {};
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SCENE_BASE_TEXT_H_
