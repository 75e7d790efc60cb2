#include "contact_path/ros/bag_reader.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <utility>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "contact_path/ros/bag_recorder.h"
#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"
#include "contact_path/scene/validate.h"

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
      trace.request = FromMessage(message->scene, message->options, message->program);
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

RecordedTrace ReadTrace(const std::string& file, const std::function<bool()>& cancelled) {
  std::vector<RecordedTrace> traces = ReadTraces(file, cancelled);
  if (traces.size() > 1) throw BagError(file + ": holds several traces");
  return std::move(traces.front());
}

}  // namespace contact_path
