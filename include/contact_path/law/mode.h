// What a law does on an arc of path, and where that ends.
#ifndef CONTACT_PATH_LAW_MODE_H_
#define CONTACT_PATH_LAW_MODE_H_

#include <algorithm>
#include <tuple>
#include <vector>

namespace contact_path {

// A state of a law, and the piece of its curves on which it is. Both are numbers of the law's own: of states, a smaller
// one is preferred where nothing else decides. One curve without ends has the piece 0 alone.
struct Mode {
  int state = 0;
  int piece = 0;
};

inline bool operator==(const Mode& a, const Mode& b) { return a.state == b.state && a.piece == b.piece; }
inline bool operator!=(const Mode& a, const Mode& b) { return !(a == b); }
inline bool operator<(const Mode& a, const Mode& b) { return std::tie(a.state, a.piece) < std::tie(b.state, b.piece); }

using Modes = std::vector<Mode>;  // by law, or of one law

inline bool HasState(const Modes& modes, int state) {
  return std::any_of(modes.begin(), modes.end(), [state](const Mode& mode) { return mode.state == state; });
}

// By law.
using States = std::vector<int>;

inline States StatesOf(const Modes& modes) {
  States states;
  states.reserve(modes.size());
  for (const Mode& mode : modes) states.push_back(mode.state);
  return states;
}

inline bool SameStates(const Modes& a, const Modes& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Mode& x, const Mode& y) { return x.state == y.state; });
}

// Something of a law that must stay >= 0 for its mode to be right.
struct Limit {
  int law = 0;
  int id = 0;  // a number of the law's own

  bool operator==(const Limit& other) const { return law == other.law && id == other.id; }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_MODE_H_
