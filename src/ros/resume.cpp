#include "contact_path/ros/resume.h"

#include <stdexcept>
#include <tuple>
#include <utility>

#include "contact_path/ros/bag_reader.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {
namespace {

[[noreturn]] void Refuse(const std::string& key, const std::string& value, const std::string& rule) {
  throw InvalidRequest(std::vector<Violation>{{key, value, rule}});
}

template <typename T>
bool IsEmpty(const T& value) {
  return value == T();
}
template <typename T>
bool IsEmpty(const std::vector<T>& values) {
  return values.empty();
}

// Calls visit(name, whether it is left out) for each field of a message that has the fields of Part.
template <typename Part, typename Message, typename Visit>
void ForEachMessageField(const Message& message, Visit visit) {
  std::apply([&](const auto&... field) { (visit(std::string(field.name), IsEmpty(message.*field.member)), ...); },
             Fields<Message>(Of<Part>()));
}

// The bag has the request; only the number of increments may be another one.
void CheckNothingElse(const contact_path_msgs::TraceRequest& request) {
  const auto require_empty = [](const std::string& key, bool empty) {
    if (!empty) Refuse(key, "", "must be left out where a bag is resumed");
  };
  ForEachMessageField<Scene>(request.scene, [&](const std::string&, bool empty) { require_empty("scene", empty); });
  ForEachMessageField<TraceOptions>(request.options, [&](const std::string& name, bool empty) {
    if (name != "max_increments") require_empty("options." + name, empty);
  });
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
