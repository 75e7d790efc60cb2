// Where a fixed-mode system stands among those of other modes.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_MODE_FRAME_H_
#define CONTACT_PATH_EQUATIONS_FIXED_MODE_FRAME_H_

#include <cstddef>
#include <vector>

#include "contact_path/equations/fixed_mode_layout.h"
#include "contact_path/equations/laws_in_modes.h"
#include "contact_path/linear/frame.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// A frame for the systems of a structure, made where one is asked for.
class FixedModeFrame {
 public:
  // All must outlive this.
  FixedModeFrame(const Structure& structure, const LawsInModes& laws, const FixedModeLayout& layout)
      : structure_(structure), laws_(laws), layout_(layout) {}

  // The layout has changed.
  void Reset() { placed_ = false; }
  // As it is for the layout, until the next Reset(). Null where the system is small, or has active limits or a fixed
  // load factor, or where very many laws act, or one couples unknowns.
  const Frame* Get();

 private:
  bool Fits(const std::vector<std::size_t>& framed) const;
  std::vector<std::size_t> LawsToFrame() const;
  void Place();

  const Structure& structure_;
  const LawsInModes& laws_;
  const FixedModeLayout& layout_;
  Frame frame_;
  std::vector<std::size_t> framed_;  // laws that have places in it, ascending
  bool placed_ = false;              // for the layout
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_MODE_FRAME_H_
