// Section forces, stresses and lengths of contacts as the check sees them, apart from response/.
#ifndef CONTACT_PATH_SRC_CHECK_ANSWERS_H_
#define CONTACT_PATH_SRC_CHECK_ANSWERS_H_

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "check/elements.h"

namespace contact_path::check {

// N, Q, M, M1, M2 of bars and segments of beams, in the order of the elements. values: as ValuesOf() orders them.
// num_positions: of the values, those before the rotations.
std::vector<std::array<double, 5>> Sections(const std::vector<std::unique_ptr<const Element>>& elements,
                                            const std::vector<double>& values, std::size_t num_positions);

// An edge along which contacts of one boundary are, from one end to the other: two nodes, or three, the second in the
// middle.
struct ContactEdge {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> contacts;  // at these nodes
};

// Where a contact is: its node, and the boundary that it may touch.
struct ContactPlace {
  std::size_t node = 0, boundary = 0;
};

// Edges of one element of a solid alone, and segments of beams, all of whose nodes have a contact with one boundary.
std::vector<ContactEdge> ContactEdges(const std::vector<std::unique_ptr<const Element>>& elements,
                                      const std::vector<ContactPlace>& contacts);

// By contact: the integral of the shape function of its node along the edges, by Gauss's rule of three points [length].
std::vector<double> ContactLengths(const std::vector<ContactEdge>& edges, std::size_t num_contacts,
                                   const std::vector<double>& positions);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_ANSWERS_H_
