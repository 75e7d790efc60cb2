// Bytes as the request of a service call, as they come from a connection: they are read or refused, then held against
// the limits of a node, converted and validated, as the node does. Converted back, they are the same request.
#include <string>
#include <utility>
#include <vector>

#include "contact_path/ros/convert.h"
#include "contact_path/ros/node_parameters.h"
#include "fuzz/target.h"
#include "ros/bytes.h"
#include "support/same_request.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;

constexpr int kMostParts = 32;  // that the node admits, of each list

void WriteOut(std::string* word, const char* meaning) {
  if (word->empty()) *word = meaning;
}

// The only changes that a conversion may make: words are written out, truth values are 0 or 1, and there is no bag.
msgs::TraceRequest Normalised(msgs::TraceRequest message) {
  WriteOut(&message.options.method, "branch");
  WriteOut(&message.options.accuracy, "balanced");
  WriteOut(&message.options.friction_law, "incremental");
  WriteOut(&message.options.stability, "true");
  WriteOut(&message.options.at_limit, "follow");
  WriteOut(&message.options.branch_rule, "automatic");
  for (msgs::Bar& bar : message.scene.bars) {
    WriteOut(&bar.strain, "biot");
    WriteOut(&bar.sense, "both");
  }
  for (msgs::Material& material : message.scene.materials) WriteOut(&material.model, "neo_hookean");
  for (msgs::Solid& solid : message.scene.solids) WriteOut(&solid.plane, "strain");
  for (msgs::Obstacle& obstacle : message.scene.obstacles) {
    WriteOut(&obstacle.shape, "half_plane");
    obstacle.inside = obstacle.inside != 0;
    obstacle.closed = obstacle.closed != 0;
  }
  const auto normalise_supports = [](auto* parts) {
    for (auto& part : *parts) {
      part.fixed_x = part.fixed_x != 0;
      part.fixed_y = part.fixed_y != 0;
      part.fixed_rotation = part.fixed_rotation != 0;
    }
  };
  normalise_supports(&message.scene.nodes);
  normalise_supports(&message.scene.supports);
  message.options.landing_checks = message.options.landing_checks != 0;
  for (msgs::Beam& beam : message.scene.beams)
    for (auto& hinged : beam.hinged) hinged = hinged != 0;
  for (msgs::BoundarySurface& surface : message.scene.surfaces) surface.closed = surface.closed != 0;
  for (msgs::Load& load : message.scene.loads) load.constant = load.constant != 0;
  for (msgs::Stage& stage : message.program) {
    for (msgs::Load& load : stage.loads) load.constant = load.constant != 0;
    stage.unload = stage.unload != 0;
  }
  message.resume.clear();
  return message;
}

void CheckConverter(std::vector<std::uint8_t> bytes) {
  msgs::TracePathRequest asked;
  try {
    ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::deserialize(in, asked);
  } catch (const ros::serialization::StreamOverrunException&) {
    return;  // roscpp refuses the call
  }
  const msgs::TraceRequest message = ToRequest(asked);

  TraceLimits limits;
  limits.max_nodes = limits.max_elements = limits.max_contacts = kMostParts;
  try {
    CheckLimits(message, limits);
  } catch (const LimitExceeded& exceeded) {
    return RequireLine(exceeded.what());
  }
  Require(message.scene.nodes.size() <= kMostParts && message.program.size() <= kMostParts, "limits hold");

  TraceRequest request;
  try {
    request = FromMessage(message);
  } catch (const InvalidRequest& refused) {
    return RequireLines(refused.violations());
  }
  RequireLines(Validate(request));
  const msgs::TraceRequest back = ToMessage(request);
  Require(Bytes(back) == Bytes(Normalised(message)), "a request is the same after it was converted and back");
  const std::string difference = FirstDifference(request, FromMessage(back));
  if (!difference.empty()) throw std::logic_error("not the same after it was converted again: " + difference);
}

}  // namespace
}  // namespace contact_path

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  bytes.reserve(1);  // roscpp moves its pointer on before it looks whether there is anything
  contact_path::CheckConverter(std::move(bytes));
  return 0;
}
