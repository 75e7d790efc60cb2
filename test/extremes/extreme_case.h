// Scenes at the extremes of numbers, geometry and contact, with what is known about them.
#ifndef CONTACT_PATH_TEST_EXTREMES_EXTREME_CASE_H_
#define CONTACT_PATH_TEST_EXTREMES_EXTREME_CASE_H_

#include <functional>
#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct ExtremeCase {
  std::string group;          // what is taken to the extreme
  std::string value;          // how far
  TraceRequest request = {};  // method and accuracy are set by who runs it
  // How far an increment is from the exact path, relative to what is at play in the scene; infinite where a state is
  // wrong. The request is the one that was traced. Empty: no answer is known, and the increment has to pass the check
  // only.
  std::function<double(const TraceRequest&, const Increment&)> error = {};
  std::string exact = {};  // what `error` compares with
  // The path may end here by name, or has to: empty where it must go on to the wanted end.
  std::vector<std::string> ends = {};
  double allowed = 1e-9;              // error of exact increments, if no more than that is attainable
  double allowed_regularised = 1e-3;  // of the other increments
  bool long_run = false;              // more than a second
  double most_seconds = 15.0;         // for the table, by method branch
};

inline std::ostream& operator<<(std::ostream& out, const ExtremeCase& extreme) {
  return out << extreme.group << ": " << extreme.value;
}

// Of all groups, in the order of the table.
std::vector<ExtremeCase> ExtremeCases();

// The groups.
void AddFrictionCases(std::vector<ExtremeCase>* cases);
void AddNumberCases(std::vector<ExtremeCase>* cases);
void AddGeometryCases(std::vector<ExtremeCase>* cases);
void AddContactCases(std::vector<ExtremeCase>* cases);
void AddCurveCases(std::vector<ExtremeCase>* cases);
void AddLengthCases(std::vector<ExtremeCase>* cases);
void AddFrameCases(std::vector<ExtremeCase>* cases);
void AddSolidCases(std::vector<ExtremeCase>* cases);
void AddDeformableCases(std::vector<ExtremeCase>* cases);

// ----- for the groups -----

// "1e-12", "0.3".
std::string Text(double value);
// The largest of the magnitudes.
double Largest(std::initializer_list<double> values);
TraceRequest Until(Scene scene, const std::string& quantity, const std::string& when, double value, double step = 0.0,
                   int max_increments = 0);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_EXTREMES_EXTREME_CASE_H_
