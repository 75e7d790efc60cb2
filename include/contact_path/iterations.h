// How often Newton's method goes on before it is given up. It ends by its own step as a rule: these bound what
// diverges.
#ifndef CONTACT_PATH_ITERATIONS_H_
#define CONTACT_PATH_ITERATIONS_H_

namespace contact_path {

inline constexpr int kMostIterations = 60;   // of few unknowns, or from far away
inline constexpr int kMostCorrections = 12;  // of all equations, from a predictor: a shorter step costs less than more

}  // namespace contact_path

#endif  // CONTACT_PATH_ITERATIONS_H_
