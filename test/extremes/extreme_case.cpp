#include "extremes/extreme_case.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace contact_path {

std::vector<ExtremeCase> ExtremeCases() {
  std::vector<ExtremeCase> cases;
  AddFrictionCases(&cases);
  AddNumberCases(&cases);
  AddGeometryCases(&cases);
  AddContactCases(&cases);
  AddCurveCases(&cases);
  AddLengthCases(&cases);
  AddFrameCases(&cases);
  AddSolidCases(&cases);
  AddDeformableCases(&cases);
  return cases;
}

std::string Text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

double Largest(std::initializer_list<double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::isnan(value) ? INFINITY : std::abs(value));
  return largest;
}

TraceRequest Until(Scene scene, const std::string& quantity, const std::string& when, double value, double step,
                   int max_increments) {
  TraceRequest request;
  request.scene = std::move(scene);
  request.options.stop = {{quantity, when, value}};
  request.options.step = step;
  request.options.max_increments = max_increments;
  return request;
}

}  // namespace contact_path
