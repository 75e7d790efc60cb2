#include "bag_rows.h"

#include <stdexcept>
#include <utility>

#include "contact_path/ros/bag_reader.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {

RecordedRows ReadRows(const std::string& bag) {
  RecordedTrace trace = ReadTrace(bag);
  const Verification verification = VerifyPath(trace.request, trace.rows);
  if (!trace.rows.empty() && !verification.findings.empty()) {
    const Finding& finding = verification.findings.front();
    throw std::runtime_error(bag + " does not prove its path: row " + std::to_string(finding.row) + ": " +
                             finding.what);
  }
  for (const Increment& row : trace.rows)
    if (row.positions.empty())
      throw std::runtime_error(bag + ": row " + std::to_string(row.index) +
                               " has no state (full_state_every); it could not be written again");
  return {std::move(trace.request), std::move(trace.rows)};
}

}  // namespace contact_path
