// Numbers that know their error.
#ifndef CONTACT_PATH_EQUATIONS_MEASURED_H_
#define CONTACT_PATH_EQUATIONS_MEASURED_H_

#include <initializer_list>

namespace contact_path {

// A value that is known up to `error` >= 0, in the same unit.
struct Measured {
  double value = 0.0;
  double error = 0.0;

  // +-1; 0 where the error hides it.
  int Sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
};

// The sign of the first of these that has one, as of the terms of a power series right behind its start; 0: none has.
inline int LeadingSign(std::initializer_list<Measured> terms) {
  for (const Measured& term : terms)
    if (const int sign = term.Sign(); sign != 0) return sign;
  return 0;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_MEASURED_H_
