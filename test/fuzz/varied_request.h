// Valid requests of all kinds, from bytes.
#ifndef CONTACT_PATH_TEST_FUZZ_VARIED_REQUEST_H_
#define CONTACT_PATH_TEST_FUZZ_VARIED_REQUEST_H_

#include <cstddef>
#include <cstdint>
#include <functional>

#include "contact_path/scene/scene.h"

namespace contact_path {

// Each two bytes are one decision, so that a change of bytes changes something of the request; beyond their end they go
// on with pseudo-random numbers that depend on all of them.
std::function<std::uint64_t()> BitsOf(const std::uint8_t* data, std::size_t size);

// A small scene of RandomRequest() (support/random_scene.h), then, each by chance: coordinates on a coarse grid, so
// that things coincide; friction, stiffness, loads and units of extreme size; linear parts; redundant obstacles and
// opposite walls without clearance; moving obstacles and supports; a load program; any options; a beam, a solid,
// moments, tractions and contacts of groups; curved obstacles; contacts with deformable surfaces; the total law of
// friction; or the two bodies of RandomBodies() (support/random_bodies.h) with these options. Always valid; at most 60
// increments, 12 by method mpec. quick: at most 5 nodes and 2 contacts, hardly ever mpec, no very short steps, and 15
// increments, 3 by mpec, for trying very many.
TraceRequest VariedRequest(std::function<std::uint64_t()> bits, bool quick = false);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_FUZZ_VARIED_REQUEST_H_
