// What streaming and recording add to a trace: the service of the node, with its bag and a subscriber, against the same
// trace without any of it. Needs a running roscore. Prints one line of CSV for each setting of full_state_every.
#include <ros/ros.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "contact_path/ros/convert.h"
#include "contact_path/ros/names.h"
#include "contact_path/ros/trace_service.h"
#include "contact_path/scene/read_scene.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 9;
constexpr int kSettings[] = {1, 10};  // of full_state_every

double Seconds(Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); }

// On a thread of its own, as the service traces: memory is not the same for the first thread of a process.
double CoreTime(const TraceRequest& request) {
  double seconds = 0.0;
  std::thread([&] {
    const Clock::time_point start = Clock::now();
    Trace(request, TraceControl());
    seconds = Seconds(start);
  }).join();
  return seconds;
}

double ServiceTime(ros::ServiceClient* client, const TraceRequest& request, const std::filesystem::path& bags,
                   double* bytes) {
  contact_path_msgs::TracePath call;
  const contact_path_msgs::TraceRequest message = ToMessage(request);
  call.request.scene = message.scene;
  call.request.options = message.options;
  const Clock::time_point start = Clock::now();
  if (!client->call(call) || call.response.bag.empty()) throw std::runtime_error("no trace: " + call.response.message);
  const double seconds = Seconds(start);
  *bytes = static_cast<double>(std::filesystem::file_size(bags / call.response.bag));
  return seconds;
}

void Measure(const std::string& file, std::ostream* table) {
  ros::NodeHandle node("~");
  NodeParameters parameters;
  parameters.bag_directory =
      std::filesystem::temp_directory_path() / ("contact_path_streaming_" + std::to_string(getpid()));
  TraceService service(node, parameters);
  long received = 0;
  const ros::Subscriber subscriber = node.subscribe<contact_path_msgs::Increment>(
      names::kIncrements, 100000, [&](const boost::shared_ptr<const contact_path_msgs::Increment>&) { ++received; });
  ros::AsyncSpinner spinner(3);
  spinner.start();
  ros::ServiceClient client = node.serviceClient<contact_path_msgs::TracePath>(names::kTrace);
  client.waitForExistence();

  const TraceRequest request = ReadTraceRequestFile(file);
  std::vector<double> ratios[std::size(kSettings)];
  double bytes[std::size(kSettings)];
  for (int round = 0; round < kRounds; ++round) {  // in turn, so that a slow moment of the machine meets all
    const double core = CoreTime(request);
    for (std::size_t i = 0; i < std::size(kSettings); ++i) {
      TraceRequest recorded = request;
      recorded.options.full_state_every = kSettings[i];
      ratios[i].push_back(ServiceTime(&client, recorded, parameters.bag_directory, &bytes[i]) / core);
    }
  }
  *table << "full_state_every,ratio,lower_quartile,upper_quartile,bag_bytes\n";
  for (std::size_t i = 0; i < std::size(kSettings); ++i) {
    std::sort(ratios[i].begin(), ratios[i].end());
    *table << kSettings[i] << ',' << ratios[i][kRounds / 2] << ',' << ratios[i][kRounds / 4] << ','
           << ratios[i][kRounds - 1 - kRounds / 4] << ',' << bytes[i] << '\n';
  }
  std::filesystem::remove_all(parameters.bag_directory);
  if (received == 0) throw std::runtime_error("the subscriber got nothing");
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  ros::init(argc, argv, "contact_path_streaming", ros::init_options::AnonymousName);
  if (argc != 3) {
    std::fputs("usage: contact_path_streaming SCENE TABLE\n", stderr);
    return 2;
  }
  try {
    std::ofstream table(argv[2]);  // the log of the node goes to standard output
    contact_path::Measure(argv[1], &table);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_path_streaming: %s\n", error.what());
    return 1;
  }
  return 0;
}
