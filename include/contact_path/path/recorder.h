// Turns accepted points into increments and hands them out.
#ifndef CONTACT_PATH_PATH_RECORDER_H_
#define CONTACT_PATH_PATH_RECORDER_H_

#include <functional>
#include <utility>

#include "contact_path/law/path_point.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/increment_lists.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

// The lists as of the point.
void FillLists(const Model& model, const PathPoint& point, const LongLists& lists, Increment* increment);

// The state of the increment, load factor included, its bars and reactions as of the point.
void FillState(const Model& model, const PathPoint& point, Increment* increment);

class Recorder {
 public:
  // lists: the long lists that increments are to have. driven: by the rule of branches the path is to go forward, and
  // it follows. on_increment takes each increment; may be empty.
  Recorder(Method method, const LongLists& lists, bool driven, std::function<void(const Increment&)> on_increment)
      : method_(method), lists_(lists), driven_(driven), on_increment_(std::move(on_increment)) {}

  // The last increment.
  const Increment& increment() const { return increment_; }
  // Given so far.
  int increments() const { return increments_; }
  // The index of the first one of the stage of the last one.
  int first_of_stage() const { return first_of_stage_; }

  // The first increment of a stage: its point, residuals and what a method found. stage: from 1; 0 = there is no
  // program.
  void Start(const Model& model, int stage, AcceptedPoint start, double time);
  // An increment of an earlier trace, as it is.
  void Repeat(const Increment& increment);
  // accepted: from the last increment on. time: what it took [s].
  void Append(const Model& model, const AcceptedPoint& accepted, double time);

  // Where the load was turned back.
  Causes Remarks() const;

 private:
  void Fill(const Model& model, const AcceptedPoint& accepted, double time);
  // load_before: of the increment before.
  void Give(double load_before);

  Method method_;
  LongLists lists_;
  bool driven_;
  std::function<void(const Increment&)> on_increment_;
  Increment increment_;
  int increments_ = 0;
  int first_of_stage_ = 0;
  int turned_back_ = 0;        // increments from which the load goes back and need not
  int first_turned_back_ = 0;  // the first of them
  int none_goes_on_ = 0;       // the first increment from which a driven path goes back, since no branch goes on
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_RECORDER_H_
