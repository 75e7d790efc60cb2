// A force and a moment on the structure.
#ifndef CONTACT_PATH_RESPONSE_RESULTANT_H_
#define CONTACT_PATH_RESPONSE_RESULTANT_H_

#include <tuple>

#include "contact_path/scene/field.h"

namespace contact_path {

struct Resultant {
  double rx = 0.0;  // [force]
  double ry = 0.0;
  double rm = 0.0;  // counterclockwise [force length]
};

template <typename P>
constexpr auto Fields(Of<Resultant>) {
  return std::tuple(Member("rx", &P::rx), Member("ry", &P::ry), Member("rm", &P::rm));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_RESPONSE_RESULTANT_H_
