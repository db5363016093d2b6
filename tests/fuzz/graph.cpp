/// Contact graphs, and the verdicts on them.

#include "src2d/cycles/contact_graph.h"
#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {

void tryInput(std::string_view bytes) {
  constexpr std::size_t kPairs = 300;
  try {
    const ContactGraph graph = parseContactGraph(bytes, "fuzz.txt");
    if (graph.pairs.size() > kPairs) return;
    const CycleVerdicts verdicts = judge(graph);
    require(verdicts.pair_rigid.size() == graph.pairs.size(), "each pair has a verdict", bytes);
  } catch (const InputError&) {
  }
}

}  // namespace merge2d::fuzz
