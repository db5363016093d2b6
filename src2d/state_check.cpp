#include "src2d/state_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "src2d/core/error.h"
#include "src2d/proofs/proof_columns.h"
#include "src2d/scene/range.h"

namespace merge2d {
namespace {

class StateCheck {
 public:
  StateCheck(const RestoredState& of, const std::string& source)
      : of_(of),
        state_(of.restored.state),
        actions_(of.restored.actions),
        source_(source),
        n_(state_.bodies.size()) {}

  void counts() const {
    const std::size_t rigids = n_ + state_.collections.size();
    require(n_ == of_.bodies.size(), "bodies");
    require(state_.rigids.size() == rigids, "rigid things");
    require(state_.extents.size() == of_.extents + state_.collections.size(), "extents");
    require(state_.joints.size() <= SceneLimits::kJoints, "joints");
    require(state_.step >= 0 && state_.step <= kMostSteps && state_.time >= 0.0, "steps");
    require(kStep.lower <= state_.h && state_.h <= kStep.upper, "the time step");
    require(state_.paced_step >= 0 && state_.paced_step <= state_.step, "the time step");
    require(state_.paced_time >= 0.0 && state_.paced_time <= state_.time, "the time step");
    require(std::isfinite(state_.time) && std::isfinite(state_.moved), "times");
  }

  void bodies() const {
    for (std::size_t i = 0; i < n_; ++i) {
      const Body &body = state_.bodies[i], &start = of_.bodies[i];
      const bool same = body.first_shape == start.first_shape &&
                        body.shape_count == start.shape_count && body.motion == start.motion &&
                        body.mass == start.mass && body.inertia == start.inertia;
      require(same, "bodies");
      const bool own = index(body.rigid) == i;
      require(own || isCollection(body.rigid), "bodies");
      const Rigid& r = state_.rigids[i];
      if (!own) {
        const Collection& c = state_.collection(body.rigid);
        const bool listed = r.member < c.members.size() && index(c.members[r.member]) == i;
        require(body.alive && (listed || c.stale), "members");
      }
      require(r.present() == (body.alive && own), "bodies");
      require(r.mass > 0.0 && r.inertia > 0.0, "masses");
    }
  }

  void rigids() const {
    std::size_t present = 0;
    for (std::size_t i = 0; i < state_.rigids.size(); ++i) {
      const Rigid& r = state_.rigids[i];
      const bool used = i < n_ || state_.collections[i - n_].id != kNoCollection;
      require(r.extent < state_.extents.size(), "extents");
      require(i < n_ ? r.extent < of_.extents : !used || r.extent >= of_.extents, "extents");
      const bool frame = r.anchor >= kFloating && r.anchor <= static_cast<FrameId>(n_);
      require(frame && r.quiet_steps >= 0, "frames");
      require(i < n_ || r.present() == used, "rigid things");
      if (!r.present()) continue;
      require(present < state_.present.size() && index(state_.present[present]) == i,
              "rigid things");
      ++present;
      require(isNear(r.x) && isNear(r.rest) && isNear(r.center), "places");
      require(std::isfinite(r.angle) && isRotation(r.rotation), "angles");
    }
    require(present == state_.present.size() && present == of_.boxes.size(), "rigid things");
    for (const Aabb& box : of_.boxes) {
      const bool ordered = (box.lower.array() <= box.upper.array()).all();
      require(ordered && isNear(box.lower) && isNear(box.upper), "boxes");
    }
    for (const Extent& extent : state_.extents) {
      const auto& bounds = extent.bounds;
      require(bounds.empty() || (isNear(bounds.lower) && isNear(bounds.upper)), "extents");
      require(isRotation(extent.box.frame.rotation), "extents");
    }
  }

  void contacts() const {
    const ContactTable& table = state_.contacts;
    require(table.order.size() + table.free_slots.size() == table.slots.size(), "contacts");
    std::vector<bool> taken(table.slots.size());
    for (const auto* list : {&table.order, &table.free_slots}) {
      for (const ContactTable::Slot slot : *list) {
        require(slot < taken.size() && !taken[slot], "contacts");
        taken[slot] = true;
      }
    }
    for (std::size_t i = 0; i < table.order.size(); ++i) {
      const Contact& contact = table.slots[table.order[i]];
      require(isContact(contact.key, contact.count), "contacts");
      const bool ascending = i == 0 || table.slots[table.order[i - 1]].key < contact.key;
      require(ascending && state_[contact.key.a].rigid != state_[contact.key.b].rigid, "contacts");
    }
    for (std::size_t i = 0; i < table.idle.size(); ++i) {
      const ContactKey& key = table.idle[i].key;
      require(isContact(key, 0) && (i == 0 || table.idle[i - 1].key < key), "near pairs");
    }
    const auto& near = state_.broadphase.near;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const NearPair& pair = near[i];
      const bool known =
          index(pair.a) < state_.rigids.size() && index(pair.b) < state_.rigids.size();
      require(known && pair.a < pair.b && (i == 0 || near[i - 1] < pair), "near pairs");
      const bool both = state_[pair.a].present() && state_[pair.b].present();  // else it is dropped
      require(!both || hasShapeTree(pair.a) || hasShapeTree(pair.b), "near pairs");
    }
    for (const ReadyPair& ready : state_.ready_before) {
      require(isBody(ready.pair.a) && isBody(ready.pair.b), "ready pairs");
    }
  }

  void joints() const {
    for (const Joint& joint : state_.joints) {
      require(isBody(joint.a) && (joint.to_world || isBody(joint.b)), "joints");
      require(joint.to_world || joint.a != joint.b, "joints");
    }
    const auto& pairs = state_.joined_pairs;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      require(isBody(pairs[i].first) && isBody(pairs[i].second), "joints");
      require(i == 0 || pairs[i - 1] <= pairs[i], "joints");
    }
  }

  void collections() const {
    std::unordered_set<std::int32_t> ids;
    std::vector<bool> listed(n_);
    for (std::size_t slot = 0; slot < state_.collections.size(); ++slot) {
      const Collection& c = state_.collections[slot];
      if (c.id == kNoCollection) continue;
      const bool known = value(c.id) > 0 && value(c.id) < state_.next_collection;
      require(known && ids.insert(value(c.id)).second, "collections");
      require(index(c.rigid) == n_ + slot && !c.members.empty(), "collections");
      const HitRun& run = c.hits;
      require(kNever <= run.first && run.first <= run.last && run.last <= state_.step,
              "collections");
      for (const BodyId body : c.members) {
        require(isBody(body) && !listed[index(body)] && state_[body].rigid == c.rigid, "members");
        listed[index(body)] = true;
      }
      checkFrame(c);
      checkInner(c);
      checkWelds(c);
      const bool goes_on = hasProofs(c) && !c.block_contact.empty() && c.laid_out.members > 0;
      if (!c.stale || goes_on) checkPlaces(c);
      if (!c.stale) checkLayout(c), checkProofs(c);  // else both are made anew
    }
    for (std::size_t i = 0; i < n_; ++i) {
      require(listed[i] == isCollection(state_.bodies[i].rigid), "members");
    }
  }

  void actions() const {
    for (const TimedSpring& spring : actions_.springs) {
      require(spring.body < n_, "springs");
      require(spring.to_body >= -1 && spring.to_body < static_cast<std::int64_t>(n_), "springs");
    }
    require(actions_.next_impulse <= actions_.impulses.size(), "impulses");
    require(actions_.next_emission <= actions_.emissions.size(), "emissions");
    for (std::size_t i = 0; i < actions_.emissions.size(); ++i) {
      const bool due = i >= actions_.next_emission;
      require(!due || !state_[actions_.emissions[i].body].alive, "emissions");
    }
    require(actions_.launches.size() == of_.launches, "launches");
    for (const auto& launch : actions_.launches) require(isBody(launch.body), "launches");
    for (const Kick& kick : actions_.user_kicks) require(isAlive(kick.body), "impulses");
    for (const Load& load : actions_.user_loads) require(isAlive(load.body), "forces");
    for (const BodyId body : actions_.loaded) require(isBody(body), "forces");
    for (const BodyId body : actions_.stirred) require(isBody(body), "changes");
  }

 private:
  static constexpr std::int64_t kMostSteps = std::int64_t{1} << 53;

  void require(bool sound, std::string_view what) const {
    if (sound) return;
    throw InputError(
        fmt::format("{}: the snapshot is damaged: its {} do not fit together", source_, what));
  }

  bool isBody(BodyId body) const { return index(body) < n_; }
  bool isAlive(BodyId body) const { return isBody(body) && state_[body].alive; }
  bool isCollection(RigidId id) const {
    return index(id) >= n_ && index(id) < state_.rigids.size() &&
           state_.collections[index(id) - n_].id != kNoCollection;
  }
  bool hasShapeTree(RigidId id) const {
    return index(id) >= n_ || state_.bodies[index(id)].shape_count > 1;
  }
  /// Within reach of any arithmetic that is done with places [m].
  static bool isNear(const Vec2& p) {
    constexpr double kFar = 1e12;
    return std::abs(p.x()) <= kFar && std::abs(p.y()) <= kFar;
  }
  static bool isRotation(const Rotation& r) { return std::abs(r.c * r.c + r.s * r.s - 1.0) < 1e-6; }
  bool ownsShape(BodyId body, std::uint32_t shape) const {
    const Body& owner = state_[body];
    return shape >= owner.first_shape && shape - owner.first_shape < owner.shape_count;
  }
  bool isContact(const ContactKey& key, int count) const {
    return isBody(key.a) && isBody(key.b) && key.a < key.b && count >= 0 && count <= 2 &&
           ownsShape(key.a, key.shape_a) && ownsShape(key.b, key.shape_b) && state_[key.a].alive &&
           state_[key.b].alive;
  }

  void checkFrame(const Collection& c) const {
    const Rigid& r = state_[c.rigid];
    require(r.mass > 0.0 && r.inertia > 0.0, "masses");
    require(r.floating() || isBody(c.anchor), "collections");
    require(!r.floating() || (r.inv_mass > 0.0 && r.inv_inertia > 0.0), "masses");
  }

  bool isMember(const Collection& c, BodyId body) const {
    return isBody(body) && state_[body].rigid == c.rigid;
  }

  /// Whether a body is a member, or belongs to the frame that the collection is fixed to.
  bool belongs(const Collection& c, BodyId body) const {
    if (!isBody(body)) return false;
    return state_[body].rigid == c.rigid ||
           (!state_[c.rigid].floating() && sameFrame(state_[rigidOf(body)], state_[c.rigid]));
  }

  /// References to bodies and lists of the collection, whether or not it is laid out.
  void checkInner(const Collection& c) const {
    for (const InternalContact& contact : c.contacts) {
      require(isContact(contact.key, contact.count), "inner contacts");
      require(belongs(c, contact.key.a) && belongs(c, contact.key.b), "inner contacts");
      require(contact.since >= kExpected && contact.since <= state_.step, "inner contacts");
      const bool has_block = contact.block != InternalContact::kNoBlock;
      require(!has_block || contact.block < c.blocks.size(), "inner contacts");
    }
    for (const ContactBlock& block : c.blocks) {
      require(block.a < n_ && block.b < n_ && block.count >= 0 && block.count <= 2, "blocks");
    }
    require(c.laid_out.active_blocks <= c.contacts.size(), "blocks");
    for (const JointBlock& joint : c.joints) {
      require(joint.a <= n_ && joint.b <= n_ && joint.joint < state_.joints.size(), "inner joints");
      require(joint.coupled >= 0 && joint.coupled <= 3, "inner joints");
    }
  }

  /// Members and contacts that have their places: all, unless some came in since the layout.
  void checkPlaces(const Collection& c) const {
    const std::size_t members = c.laid_out.members;
    const std::size_t contacts = c.stale ? c.block_contact.size() : c.contacts.size();
    require(members <= c.members.size() && contacts <= c.contacts.size(), "collections");
    require(c.stale || members == c.members.size(), "members");
    for (std::size_t i = 0; i < members; ++i) {
      require(state_[rigidOf(c.members[i])].member == i, "members");
    }
    const bool isAway = areBlocksAway(c);
    for (std::size_t i = 0; i < contacts; ++i) {
      const InternalContact& contact = c.contacts[i];
      require(contact.weld < c.welds.size(), "inner contacts");
      require(isAway || contact.block < c.blocks.size(), "inner contacts");
    }
    require(isAway || c.block_contact.empty() || c.block_contact.size() == c.blocks.size(),
            "blocks");
    require(!isAway || c.block_contact.size() == contacts, "blocks");
    std::vector<std::uint8_t> seen(contacts, 0);
    for (const std::uint32_t i : c.block_contact) {
      require(i < contacts && seen[i]++ == 0, "blocks");
    }
    for (const Weld& weld : c.welds) {  // the frame's node is the last
      const bool run = weld.first <= contacts && weld.count <= contacts - weld.first;
      require(run && weld.node_a <= members && weld.node_b <= members, "welds");
    }
  }

  /// Lists that a layout has put in order.
  void checkLayout(const Collection& c) const {
    const int points = c.laid_out.points;
    require(points >= 0 && static_cast<std::size_t>(points) <= 2 * c.contacts.size(), "blocks");
    require(c.push.of.empty() || c.push.of.size() == c.members.size(), "inner forces");
    require(std::ranges::all_of(c.push.unbalanced, [&](auto m) { return m < c.members.size(); }),
            "inner forces");
    checkWeldsOfMembers(c);
  }

  void checkWeldsOfMembers(const Collection& c) const {
    const auto& numbers = c.welds_of.numbers;
    if (numbers.empty()) return;
    const std::size_t begin = c.members.size() + 1;
    require(numbers.size() >= begin && numbers.front() == begin, "welds");
    require(numbers[c.members.size()] == numbers.size(), "welds");
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(begin);
    require(std::is_sorted(numbers.begin(), end), "welds");
    require(std::all_of(end, numbers.end(), [&](auto weld) { return weld < c.welds.size(); }),
            "welds");
  }

  void checkWelds(const Collection& c) const {
    const std::size_t sorted = c.laid_out.sorted_welds;
    require(sorted <= c.welds.size(), "welds");
    for (std::size_t i = 0; i < c.welds.size(); ++i) {
      const Weld& weld = c.welds[i];
      require(isBody(weld.a) && isBody(weld.b) && weld.a < weld.b, "welds");
      const bool first = i == 0 || i >= sorted;
      require(first || std::pair(c.welds[i - 1].a, c.welds[i - 1].b) < std::pair(weld.a, weld.b),
              "welds");
    }
  }

  void checkProofs(const Collection& c) const {
    require(c.certificate.size() <= 1, "proofs");
    for (const LoadCertificate& proof : c.certificate) {
      for (std::size_t i = 0; i < proof.columns.size(); ++i) {
        require(isMember(c, proof.columns[i]), "proofs");
        require(i == 0 || proof.columns[i - 1] < proof.columns[i], "proofs");
      }
      const std::size_t witnesses = proof.witnesses.size();
      require(witnesses <= LoadCertificate::kMost && proof.inherited <= witnesses, "proofs");
      const NewtonIterate& newton = proof.search.newton;
      require(newton.u.size() == (newton.unknowns.empty() ? 0 : c.members.size()), "proofs");
      require(proof.heaviest == LoadCertificate{}.heaviest || isMember(c, proof.heaviest),
              "proofs");
      const std::size_t movers = proof.search.movers.size();
      require(movers == 0 || movers == c.welds.size(), "proofs");
      for (const Witness& witness : proof.witnesses) {
        require(witness.outer.size() == proof.columns.size(), "proofs");
        const std::size_t blocks = areBlocksAway(c) ? c.block_contact.size() : c.blocks.size();
        require(witness.lambda.size() == blocks + c.joints.size(), "proofs");
      }
      require(proof.gram.size() == witnesses * witnesses, "proofs");
    }
  }

  const RestoredState& of_;
  const State& state_;
  const Actions& actions_;
  const std::string& source_;
  std::size_t n_;
};

}  // namespace

void checkRestored(const RestoredState& of, const std::string& source) {
  const StateCheck check(of, source);
  check.counts();
  check.bodies();
  check.rigids();
  check.contacts();
  check.joints();
  check.collections();
  check.actions();
}

}  // namespace merge2d
