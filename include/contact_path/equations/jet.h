// A scalar along a curve.
#ifndef CONTACT_PATH_EQUATIONS_JET_H_
#define CONTACT_PATH_EQUATIONS_JET_H_

namespace contact_path {

// Value and first two derivatives by the parameter of the curve.
struct Jet {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_JET_H_
