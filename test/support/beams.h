// Beams of scenes that tests make.
#ifndef CONTACT_PATH_TEST_SUPPORT_BEAMS_H_
#define CONTACT_PATH_TEST_SUPPORT_BEAMS_H_

#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

inline Beam Between(const std::string& name, const std::string& first, const std::string& second, double EA, double EI,
                    int segments) {
  Beam beam;
  beam.name = name;
  beam.nodes = {first, second};
  beam.EA = EA;
  beam.EI = EI;
  beam.segments = segments;
  return beam;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_BEAMS_H_
