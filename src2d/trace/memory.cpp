/// How much memory a world holds.

#include "src2d/core/memory.h"

#include "src2d/trace/capture.h"

namespace merge2d {
namespace {

std::size_t bytesOfBroadphase(const Broadphase& b) {
  std::size_t total = b.tree.memoryBytes() + bytesOf(b.shape_trees, b.shape_leaves, b.near) +
                      b.parked_near.memoryBytes();
  for (const auto& tree : b.shape_trees) {
    if (tree) total += sizeof(AabbTree) + tree->memoryBytes();
  }
  return total;
}

std::size_t bytesOfProofs(const Collection& c) {
  std::size_t total = bytesOf(c.certificate);
  for (const LoadCertificate& proof : c.certificate) {
    const ProofSearch& search = proof.search;
    total += bytesOf(search.start, search.load.outer, search.load.lambda, search.nncg.before,
                     search.nncg.direction, search.nncg.u_before, search.nncg.u_direction,
                     search.newton.unknowns, search.newton.u, search.movers);
    total += bytesOf(proof.columns, proof.witnesses, proof.gram);
    for (const Witness& witness : proof.witnesses) total += bytesOf(witness.outer, witness.lambda);
  }
  return total;
}

std::size_t bytesOfState(const State& s) {
  std::size_t total =
      bytesOf(s.colliders, s.collider_bounds, s.shape_collider, s.shape_body, s.first_sibling,
              s.siblings, s.bodies, s.rigids, s.extents, s.joints, s.joined_pairs, s.ready_before,
              s.parked.slept) +
      s.present.memoryBytes() + s.collections.memoryBytes() + s.contacts.parked.memoryBytes() +
      s.contacts.parked_idle.memoryBytes() + s.joint_lists.of_body.memoryBytes() +
      bytesOf(s.joint_lists.present) + s.joint_lists.parked.memoryBytes() +
      bytesOf(s.contacts.slots, s.contacts.free_slots, s.contacts.order, s.contacts.idle) +
      bytesOfBroadphase(s.broadphase);
  for (const Collection& c : s.collections.all()) {
    total += bytesOf(c.members, c.contacts, c.blocks, c.block_contact, c.welds, c.welds_of.numbers,
                     c.joints, c.push.of, c.push.unbalanced) +
             bytesOfProofs(c);
  }
  return total;
}

std::size_t bytesOfBuffers(const NncgBuffers& m) {
  return bytesOf(m.before, m.direction, m.u_before, m.u_direction);
}

std::size_t bytesOfSweeps(const Scratch& s) {
  std::size_t total = bytesOf(s.sweeps);
  for (const SweepMemory& memory : s.sweeps) {
    total += bytesOfBuffers(memory.nncg) + memory.wide.memoryBytes() +
             bytesOf(memory.trial_u, memory.kinds);
  }
  return total;
}

std::size_t bytesOfScratch(const Scratch& s) {
  return bytesOf(s.loads, s.kicks, s.springs, s.stretches, s.spring_gain, s.pairs, s.events,
                 s.moved, s.moved_flag, s.candidates, s.touching, s.seams, s.loose_sides,
                 s.fixed_covers, s.touchers, s.casts, s.kick_order, s.load_order, s.near_candidates,
                 s.near_refined, s.paired_with, s.meetings, s.seeds, s.stirred, s.started,
                 s.restless, s.island_awake) +
         bytesOf(s.sweep_u, s.sweep_contacts, s.sweep_joints, s.near_collection, s.outer_loads,
                 s.load_place, s.doubts, s.regions, s.open_members, s.open_rows, s.open_start,
                 s.open, s.swept, s.opened, s.overloaded_joints, s.ready, s.ties) +
         bytesOf(s.u, s.blocks, s.row_sources, s.islands, s.island_bodies, s.island_of, s.colours,
                 s.joint_order, s.joint_blocks, s.taut_links, s.block_order, s.by_colour,
                 s.hit_ways) +
         bytesOfSweeps(s) + s.sets.memoryBytes() +
         bytesOf(s.ahead, s.found, s.island_changes, s.island_roots, s.start_motions);
}

}  // namespace

std::size_t memoryBytes(const State& state, const Scratch& scratch) {
  return bytesOfState(state) + bytesOfScratch(scratch);
}

}  // namespace merge2d
