// Elastic constants of a material, from those that the scene gives.
#ifndef CONTACT_PATH_SCENE_ELASTICITY_H_
#define CONTACT_PATH_SCENE_ELASTICITY_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Lame's parameters [force/length^2].
struct Lame {
  double lambda = 0.0;
  double mu = 0.0;
};

// lambda = E nu / ((1 + nu) (1 - 2 nu)), mu = E / (2 (1 + nu)), where the scene gives E.
inline Lame LameOf(const Material& material) {
  if (material.E == 0.0) return {material.lambda, material.mu};
  const double mu = material.E / (2.0 * (1.0 + material.nu));
  return {2.0 * mu * material.nu / (1.0 - 2.0 * material.nu), mu};
}

// E = mu (3 lambda + 2 mu) / (lambda + mu) [force/length^2].
inline double YoungModulus(const Lame& of) { return of.mu * (3.0 * of.lambda + 2.0 * of.mu) / (of.lambda + of.mu); }

// nu = lambda / (2 (lambda + mu)).
inline double PoissonRatio(const Lame& of) { return of.lambda / (2.0 * (of.lambda + of.mu)); }

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_ELASTICITY_H_
