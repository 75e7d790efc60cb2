#include "contact_path/study/study_outputs.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/path/csv.h"
#include "contact_path/scene/expand.h"
#include "support/traced_path.h"

namespace contact_path::path_column_test {
namespace {

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

// Holds every column of the CSV of the last of some increments, but for the time, against the cell of the same name.
void ExpectColumnsOfTheCsv(const std::string& scene) {
  TraceRequest request = ReadExample(scene);
  request.options.max_increments = 20;
  const ExpandedRequest expanded(request);
  const Increment increment = TraceIncrements(request).increments.back();
  const CsvWriter csv(request);
  std::ostringstream header, row;
  csv.WriteHeader(header);
  csv.WriteRow(increment, row);
  const std::string names = header.str(), values = row.str();
  const std::vector<std::string> name = Cells(names.substr(0, names.size() - 1));
  const std::vector<std::string> value = Cells(values.substr(0, values.size() - 1));
  ASSERT_EQ(name.size(), value.size());
  const SceneIndex index(expanded.Get().scene);
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == "solve_time") continue;
    SCOPED_TRACE(scene + ": " + name[i]);
    const PathColumn column(name[i], expanded.Get(), index);
    if (column.IsNumber()) {
      EXPECT_EQ(column.Number(increment), std::stod(value[i]));
    } else {
      EXPECT_EQ(column.Word(increment), value[i]);
    }
  }
}

TEST(PathColumn, IsTheCellOfTheCsv) {
  ExpectColumnsOfTheCsv("rough_truss");
  ExpectColumnsOfTheCsv("portal_frame");      // rotations
  ExpectColumnsOfTheCsv("press_slide_lift");  // stages
}

std::string RuleOf(const std::string& name, const std::string& scene = "rough_truss") {
  const TraceRequest request = ReadExample(scene);
  try {
    const PathColumn column(name, request, SceneIndex(request.scene));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "is a column";
}

TEST(PathColumn, MayBeSpelledAsAQuantity) {
  EXPECT_EQ(RuleOf("apex.y"), "is a column");
  EXPECT_EQ(RuleOf("foot@floor.rn"), "is a column");
}

TEST(PathColumn, SaysWhatANameMustBe) {
  EXPECT_EQ(RuleOf("x_apx"), "must be of a node or an obstacle of the scene; did you mean apex?");
  EXPECT_EQ(RuleOf("rn_foot@flor"), "must be of a contact of the scene; did you mean foot@floor?");
  EXPECT_EQ(RuleOf("state_apex@floor").substr(0, 34), "must be of a contact of the scene");
  EXPECT_EQ(RuleOf("rotation_apex"), "must be of a node that a beam turns");
  EXPECT_EQ(RuleOf("disipation"),
            "must be a column of the CSV, as load_factor, x_<node> or rn_<contact>; did you mean dissipation?");
  EXPECT_EQ(RuleOf("landing_robust"), "must be of a trace with landing_checks");
  EXPECT_EQ(RuleOf("stage"), "must be of a scene with a program");
  EXPECT_EQ(RuleOf("solve_time"), "must be the same whenever it is computed: solve_time is not");
}

}  // namespace
}  // namespace contact_path::path_column_test
