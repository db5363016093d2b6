#include "src2d/dynamics/row_sources.h"

#include "src2d/core/memory.h"

namespace merge2d {
namespace {

/// The points of one pair of bodies, two to a block where they share a normal.
void listSources(const State& state, const BodyPair& pair, Scratch& scratch) {
  const RigidId a = moverOf(state, scratch, pair.a), b = moverOf(state, scratch, pair.b);
  if (scratch.u[index(a)].inv_mass == 0.0 && scratch.u[index(b)].inv_mass == 0.0) return;
  auto& sources = scratch.row_sources;
  const std::size_t first = sources.size();
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const ContactTable::Slot slot = state.contacts.order[i];
    const Contact& contact = state.contacts[slot];
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(contact.count); ++k) {
      const PointIndex point = 2 * slot + k;
      const bool joins =
          sources.size() > first && sources.back().count() == 1 &&
          state.contacts.contactOf(sources.back().points[0]).normal == contact.normal;
      if (joins) {
        sources.back().points[1] = point;
      } else {
        sources.push_back({{point, kNone}});
      }
    }
  }
}

}  // namespace

void listRowSources(const State& state, Scratch& scratch) {
  scratch.row_sources.clear();
  reserveTightly(scratch.row_sources, scratch.pairs.size());
  for (const BodyPair& pair : scratch.pairs) listSources(state, pair, scratch);
  const auto& inner = scratch.open_rows;
  scratch.row_sources.insert(scratch.row_sources.end(), inner.begin(), inner.end());
}

RowEnds endsOf(const State& state, const Scratch& scratch, const RowSource& source) {
  if (source.isInner()) {
    const ContactBlock& k = state.collections[source.slot()].blocks[source.block()];
    return {RigidId{k.a}, RigidId{k.b}};
  }
  const ContactKey& key = state.contacts.contactOf(source.points[0]).key;
  return {moverOf(state, scratch, key.a), moverOf(state, scratch, key.b)};
}

}  // namespace merge2d
