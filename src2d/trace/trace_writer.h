#pragma once
/// A run as JSON Lines: a header, then one line per time step with the state after it.

#include <ostream>
#include <vector>

#include "src2d/scene/scene.h"
#include "src2d/trace/json_text.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// How every trace begins.
inline constexpr std::string_view kTraceStart = R"({"type":"header","format":"merge2d-trace",)";

struct TraceOptions {
  bool decisions = false;  ///< write the tests of the criteria; the world must record them
  bool timings = true;     ///< write the seconds of the stages: two runs then differ in them alone
};

/// Writes each line as soon as it is known. The state of `out` tells whether that went well.
class TraceWriter {
 public:
  static constexpr int kVersion = 1;

  /// Writes the header.
  TraceWriter(std::ostream& out, const Scene& scene, Mode mode, const std::vector<BodyInfo>& bodies,
              const TraceOptions& options = {});

  void add(const Snapshot& snapshot);

 private:
  void write();

  std::ostream& out_;
  TraceOptions options_;
  JsonText line_;  ///< kept for its memory
};

/// One event: {"type":"merge","a":1,"b":2,"collection":3,"reason":null}, with `step` and `t` first
/// where the line it stands in does not tell them.
void writeEvent(JsonText& out, const Event& event, const Snapshot* when = nullptr);

}  // namespace merge2d
