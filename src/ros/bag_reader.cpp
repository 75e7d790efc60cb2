#include "contact_path/ros/bag_reader.h"

#include <exception>
#include <fstream>
#include <new>
#include <utility>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "contact_path/ros/bag_recorder.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {
namespace {

bool EndsIn(const std::string& topic, const char* name) {
  const std::string end = std::string("/") + name;
  return topic.size() >= end.size() && topic.compare(topic.size() - end.size(), end.size(), end) == 0;
}

bool StartsAsBag(const std::string& file) {
  const std::string magic = "#ROSBAG";
  std::string start(magic.size(), ' ');
  return std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size())) &&
         start == magic;
}

template <typename Message>
typename Message::ConstPtr Read(const rosbag::MessageInstance& instance) {
  typename Message::ConstPtr message = instance.instantiate<Message>();
  if (!message) throw BagError(instance.getTopic() + ": its messages are not of the type of this version");
  return message;
}

// The action has a topic of that name, too.
const char* const kResultType = ros::message_traits::datatype<contact_path_msgs::TraceResult>();

std::vector<RecordedTrace> ReadOpen(const rosbag::Bag& bag, const std::function<bool()>& cancelled) {
  std::vector<RecordedTrace> traces;
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& instance : view) {
    if (cancelled && cancelled()) throw ReadingCancelled(bag.getFileName());
    const std::string& topic = instance.getTopic();
    if (EndsIn(topic, names::kRequest)) {
      const auto message = Read<contact_path_msgs::TraceRequest>(instance);
      if (!traces.empty() && traces.back().increments.empty()) traces.pop_back();
      RecordedTrace& trace = traces.emplace_back();
      trace.request = FromMessage(*message);
      const std::vector<Violation> violations = Validate(trace.request);
      if (!violations.empty()) throw InvalidRequest(violations);
    } else if (EndsIn(topic, names::kIncrements)) {
      if (traces.empty()) throw BagError("no request before the increments: not the bag of a trace");
      traces.back().increments.push_back(FromMessage(*Read<contact_path_msgs::Increment>(instance)));
    } else if (EndsIn(topic, names::kResult) && instance.getDataType() == kResultType && !traces.empty()) {
      traces.back().result = *Read<contact_path_msgs::TraceResult>(instance);
    }
  }
  if (traces.empty()) throw BagError("no request: not the bag of a trace");
  if (traces.size() > 1 && traces.back().increments.empty()) traces.pop_back();
  return traces;
}

[[noreturn]] void Refuse(const std::string& key, const std::string& value, const std::string& rule) {
  throw InvalidRequest(std::vector<Violation>{{key, value, rule}});
}

// The bag has the request; only the number of increments may be another one.
void CheckNothingElse(const contact_path_msgs::TraceRequest& request) {
  const auto require_empty = [](const std::string& key, bool empty) {
    if (!empty) Refuse(key, "", "must be left out where a bag is resumed");
  };
  require_empty("scene", request.scene == contact_path_msgs::Scene());
  const contact_path_msgs::TraceOptions none;
  ForEachFieldPair<TraceOptions, contact_path_msgs::TraceOptions>([&](const auto&, const auto& field) {
    if (field.name != "max_increments")
      require_empty("options." + std::string(field.name), request.options.*field.member == none.*field.member);
  });
  require_empty("program", request.program.empty());
}

}  // namespace

std::vector<RecordedTrace> ReadTraces(const std::string& file, const std::function<bool()>& cancelled) {
  try {
    rosbag::Bag bag;
    bag.open(file, rosbag::bagmode::Read);
    return ReadOpen(bag, cancelled);
  } catch (const ReadingCancelled&) {
    throw;
  } catch (const rosbag::BagUnindexedException&) {
    throw BagError(file + ": was never closed: run `rosbag reindex` on it first");
  } catch (const rosbag::BagIOException& error) {
    if (!std::filesystem::exists(file)) throw BagError(file + ": no such file");
    if (!StartsAsBag(file)) throw BagError(file + ": is no bag");
    throw BagError(file + ": is cut off (" + error.what() + "): `rosbag reindex` saves what is complete");
  } catch (const BagError& error) {
    throw BagError(file + ": " + error.what());
  } catch (const InvalidRequest& error) {
    throw BagError(file + ": the request is not valid: " + error.violations().front().ToLine());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw BagError(file + ": cannot be read: " + error.what());
  }
}

RecordedTrace ReadTraceSoFar(const std::string& bag, const std::function<bool()>& cancelled) {
  std::vector<RecordedTrace> traces = ReadTraces(bag, cancelled);
  if (traces.size() > 1) throw BagError(bag + ": holds several traces");
  RecordedTrace& trace = traces.front();
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
  return std::move(trace);
}

RecordedTrace ReadTraceSoFar(const std::filesystem::path& directory, const contact_path_msgs::TraceRequest& request,
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
  RecordedTrace so_far;
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
