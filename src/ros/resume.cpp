#include "contact_path/ros/resume.h"

#include <stdexcept>
#include <utility>

#include "contact_path/ros/bag_reader.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {
namespace {

[[noreturn]] void Refuse(const std::string& key, const std::string& value, const std::string& rule) {
  Violation violation;
  violation.key = key;
  violation.value = value;
  violation.rule = rule;
  throw InvalidRequest({violation});
}

// The bag has them; only the number of increments may be another one.
void CheckNothingElse(const contact_path_msgs::TraceRequest& request) {
  const auto require_empty = [](const std::string& key, bool empty) {
    if (!empty) Refuse(key, "", "must be left out where a bag is resumed");
  };
  const contact_path_msgs::Scene& scene = request.scene;
  const contact_path_msgs::TraceOptions& options = request.options;
  require_empty("scene", scene.name.empty() && scene.nodes.empty() && scene.bars.empty() &&
                             scene.superelements.empty() && scene.loads.empty() && scene.obstacles.empty() &&
                             scene.contacts.empty() && scene.support_motions.empty() && scene.obstacle_motions.empty());
  require_empty("options.method", options.method.empty());
  require_empty("options.accuracy", options.accuracy.empty());
  require_empty("options.direction", options.direction == 0.0);
  require_empty("options.step", options.step == 0.0);
  require_empty("options.full_state_every", options.full_state_every == 0);
  require_empty("options.stop", options.stop.empty());
  require_empty("options.branch_choices", options.branch_choices.empty());
  require_empty("program", request.program.empty());
}

}  // namespace

TraceSoFar ReadTraceSoFar(const std::string& bag, const std::function<bool()>& cancelled) {
  RecordedTrace trace = ReadTrace(bag, cancelled);
  if (!trace.increments.empty()) {
    const Verification verification = VerifyPath(trace.request, trace.increments, [&] {
      if (cancelled && cancelled()) throw ReadingCancelled(bag);
    });
    if (!verification.findings.empty()) {
      const Finding& finding = verification.findings.front();
      throw std::runtime_error(bag + " does not prove its path: increment " + std::to_string(finding.increment) + ": " +
                               finding.what);
    }
  }
  return {std::move(trace.request), std::move(trace.increments)};
}

TraceSoFar ReadTraceSoFar(const std::filesystem::path& directory, const contact_path_msgs::TraceRequest& request,
                          const std::function<bool()>& cancelled) {
  const std::filesystem::path name = request.resume;
  if (name.filename() != name || request.resume == "." || request.resume == "..")
    Refuse("resume", request.resume, "must be the name of a bag in the bag directory");
  const std::filesystem::path file = directory / name;
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::symlink_status(file, error).type();
  if (type == std::filesystem::file_type::not_found)
    Refuse("resume", request.resume, "there is no such bag in the bag directory");
  if (type != std::filesystem::file_type::regular)
    Refuse("resume", request.resume, "must be the name of a bag in the bag directory");
  CheckNothingElse(request);
  TraceSoFar so_far;
  try {
    so_far = ReadTraceSoFar(file.string(), cancelled);
  } catch (const ReadingCancelled&) {
    throw;
  } catch (const std::runtime_error& unreadable) {
    Refuse("resume", request.resume, unreadable.what());
  }
  if (request.options.max_increments != 0) so_far.request.options.max_increments = request.options.max_increments;
  return so_far;
}

}  // namespace contact_path
