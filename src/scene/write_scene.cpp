#include "contact_path/scene/write_scene.h"

#include <yaml-cpp/yaml.h>

#include <limits>

namespace contact_path {
namespace {

// One map on one line, of the fields that differ from their default.
class Line {
 public:
  explicit Line(YAML::Emitter* out) : out_(*out) { out_ << YAML::Flow << YAML::BeginMap; }
  ~Line() { out_ << YAML::EndMap; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void Text(const char* key, const std::string& value) { out_ << YAML::Key << key << YAML::Value << Quoted(value); }
  void Word(const char* key, std::string_view value) { out_ << YAML::Key << key << YAML::Value << std::string(value); }
  template <typename T>
  void Value(const char* key, T value, T left_out = T()) {
    if (value != left_out) out_ << YAML::Key << key << YAML::Value << value;
  }
  void Texts(const char* key, const std::vector<std::string>& values) {
    out_ << YAML::Key << key << YAML::Value << YAML::BeginSeq;
    for (const std::string& value : values) out_ << Quoted(value);
    out_ << YAML::EndSeq;
  }
  void Numbers(const char* key, const std::vector<double>& values) {
    out_ << YAML::Key << key << YAML::Value << YAML::BeginSeq;
    for (const double value : values) out_ << value;
    out_ << YAML::EndSeq;
  }

 private:
  // Quotes are needed only by what would read as something else, e.g. "1" or "yes".
  struct QuotedText {
    const std::string& text;
    friend YAML::Emitter& operator<<(YAML::Emitter& out, const QuotedText& quoted) {
      return out << YAML::DoubleQuoted << quoted.text << YAML::Auto;
    }
  };
  static QuotedText Quoted(const std::string& text) { return {text}; }

  YAML::Emitter& out_;
};

template <typename Part, typename Write>
void WriteList(const char* key, const std::vector<Part>& parts, YAML::Emitter* out, Write write) {
  if (parts.empty()) return;
  *out << YAML::Key << key << YAML::Value << YAML::Block << YAML::BeginSeq;
  for (const Part& part : parts) {
    Line line(out);
    write(part, line);
  }
  *out << YAML::EndSeq;
}

void WriteLoads(const std::vector<Load>& loads, YAML::Emitter* out) {
  WriteList("loads", loads, out, [](const Load& load, Line& line) {
    line.Text("node", load.node);
    line.Value("fx", load.fx);
    line.Value("fy", load.fy);
    line.Value("constant", load.constant);
  });
}

void WriteMotions(const std::vector<SupportMotion>& supports, const std::vector<ObstacleMotion>& obstacles,
                  YAML::Emitter* out) {
  WriteList("support_motions", supports, out, [](const SupportMotion& motion, Line& line) {
    line.Text("node", motion.node);
    line.Value("dx", motion.dx);
    line.Value("dy", motion.dy);
  });
  WriteList("obstacle_motions", obstacles, out, [](const ObstacleMotion& motion, Line& line) {
    line.Text("obstacle", motion.obstacle);
    line.Value("dx", motion.dx);
    line.Value("dy", motion.dy);
  });
}

void WriteScene(const Scene& scene, YAML::Emitter* out) {
  *out << YAML::Block << YAML::BeginMap;
  *out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << scene.name << YAML::Auto;
  WriteList("nodes", scene.nodes, out, [](const Node& node, Line& line) {
    line.Text("name", node.name);
    line.Value("x", node.x);
    line.Value("y", node.y);
    line.Value("fixed_x", node.fixed_x);
    line.Value("fixed_y", node.fixed_y);
  });
  WriteList("bars", scene.bars, out, [](const Bar& bar, Line& line) {
    line.Texts("nodes", bar.nodes);
    line.Value("EA", bar.EA);
    line.Value("rest_length", bar.rest_length);
    if (bar.strain != StrainMeasure::kBiot) line.Word("strain", ToString(bar.strain));
  });
  WriteList("superelements", scene.superelements, out, [](const Superelement& part, Line& line) {
    line.Texts("nodes", part.nodes);
    line.Numbers("stiffness", part.stiffness);
    if (!part.rest_positions.empty()) line.Numbers("rest_positions", part.rest_positions);
  });
  WriteLoads(scene.loads, out);
  WriteList("obstacles", scene.obstacles, out, [](const Obstacle& obstacle, Line& line) {
    line.Text("name", obstacle.name);
    line.Word("shape", ToString(obstacle.shape));
    line.Value("px", obstacle.px);
    line.Value("py", obstacle.py);
    line.Value("nx", obstacle.nx);
    line.Value("ny", obstacle.ny);
    line.Value("friction", obstacle.friction);
  });
  WriteList("contacts", scene.contacts, out, [](const ContactCandidate& contact, Line& line) {
    line.Text("node", contact.node);
    line.Text("obstacle", contact.obstacle);
  });
  WriteMotions(scene.support_motions, scene.obstacle_motions, out);
  *out << YAML::EndMap;
}

void WriteOptions(const TraceOptions& options, YAML::Emitter* out) {
  *out << YAML::Block << YAML::BeginMap;
  *out << YAML::Key << "method" << YAML::Value << std::string(ToString(options.method));
  *out << YAML::Key << "accuracy" << YAML::Value << std::string(ToString(options.accuracy));
  *out << YAML::Key << "direction" << YAML::Value << options.direction;
  *out << YAML::Key << "step" << YAML::Value << options.step;
  *out << YAML::Key << "max_increments" << YAML::Value << options.max_increments;
  *out << YAML::Key << "full_state_every" << YAML::Value << options.full_state_every;
  WriteList("stop", options.stop, out, [](const StopCriterion& stop, Line& line) {
    line.Text("quantity", stop.quantity);
    line.Text("when", stop.when);
    line.Value("value", stop.value);
  });
  WriteList("branch_choices", options.branch_choices, out, [](const BranchChoice& choice, Line& line) {
    line.Value("event", choice.event);
    line.Value("increment", choice.increment);
    line.Value("branch", choice.branch);
  });
  *out << YAML::EndMap;
}

void WriteProgram(const std::vector<Stage>& program, YAML::Emitter* out) {
  *out << YAML::BeginSeq;
  for (const Stage& stage : program) {
    *out << YAML::Block << YAML::BeginMap;
    *out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << stage.name << YAML::Auto;
    *out << YAML::Key << "target" << YAML::Value << stage.Target();
    WriteLoads(stage.loads, out);
    WriteMotions(stage.support_motions, stage.obstacle_motions, out);
    *out << YAML::EndMap;
  }
  *out << YAML::EndSeq;
}

}  // namespace

std::string WriteTraceRequest(const TraceRequest& request) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  out << YAML::BeginMap << YAML::Key << "scene" << YAML::Value;
  WriteScene(request.scene, &out);
  out << YAML::Key << "options" << YAML::Value;
  WriteOptions(request.options, &out);
  if (!request.program.empty()) {
    out << YAML::Key << "program" << YAML::Value;
    WriteProgram(request.program, &out);
  }
  out << YAML::EndMap << YAML::Newline;
  return out.c_str();
}

}  // namespace contact_path
