#include "src2d/contact/hidden_sides.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "src2d/contact/internal_edges.h"
#include "src2d/contact/seams.h"

namespace merge2d {
namespace {

/// Seams of bodies that cannot part have the same number: that of the body, or one for all bodies
/// that do not respond to forces.
std::uint32_t fixedTo(const State& state, const SeamContact& seam) {
  const BodyId body = bodyOf(state, seam);
  return state.responds(body) ? static_cast<std::uint32_t>(body) : kNone;
}

/// Lists the loose sides among the seams of one toucher.
void listLooseSides(const State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  const Pose toucher = state.pose(state.shape_body[seams.front().toucher]);
  scratch.loose_sides.clear();
  for (std::uint32_t i = 0; i < seams.size(); ++i) {
    const Contact& contact = contactOf(state, seams[i]);
    const std::uint32_t shape = shapeOf(contact, seams[i]);
    if (contact.count == 0 || !isLoose(state, contact, shape)) continue;
    const Vec2 met = state.pose(state.shape_body[shape]) * Side(state, scratch, seams[i]).points[0];
    scratch.loose_sides.push_back({i, fixedTo(state, seams[i]), toucher.toLocal(met)});
  }
}

/// A box, in the frame `toucher`, around all points that are no farther than `ahead` outside each
/// face of the shape of `t`. A face at the distance r_i from an inner point moves out to
/// r_i + ahead ≤ r_i (1 + ahead / r), where r is the least r_i: the points lie in the shape
/// enlarged by this factor about the inner point. Twice the way leaves room for rounding. For a
/// shape too thin to have an inner point the box is infinite, or of no numbers.
Aabb surroundings(const State& state, const SeamContact& t, const Pose& toucher, double ahead) {
  const std::uint32_t shape = shapeOf(contactOf(state, t), t);
  const Collider& cover = state.collider(shape);
  const double r = std::max(0.0, -signedDistance(cover, cover.origin()));
  const double factor = 1.0 + 2.0 * ahead / r;
  const auto enlarged = [&](const Vec2& corner) -> Vec2 {
    return cover.origin() + factor * (corner - cover.origin());
  };
  const Aabb& box = state.bounds(shape);
  return placed(toucher.toLocal(state.pose(state.shape_body[shape])),
                {enlarged(box.lower), enlarged(box.upper)});
}

/// Marks the loose sides that are hidden by a cover of another body, where the two bodies may part.
///
/// There `hides` asks that the toucher rests on the cover and meets the side no farther than
/// `ahead` from it. The sides are sorted along the toucher: those in the surroundings of a cover
/// are a run of the list, and the cover is compared with all of them. Where N boxes stand on one
/// floor a run has a few sides. The order of the pairs does not matter: `hides` reads no other
/// contact, and a contact that bears is never emptied here.
void markBesideCovers(const State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  const std::uint32_t shape = seams.front().toucher;
  const Pose toucher = state.pose(state.shape_body[shape]);
  const Vec2 extent = state.bounds(shape).extent();
  const int along = extent.x() >= extent.y() ? 0 : 1, across = 1 - along;
  const auto place = [&](const LooseSide& side) { return side.met[along]; };
  std::vector<LooseSide>& sides = scratch.loose_sides;
  std::ranges::sort(sides, {}, place);
  for (const SeamContact& t : seams) {
    const Contact& contact = contactOf(state, t);
    if (contact.count == 0 || !bears(contact) || bouncesOff(state, contact)) continue;
    const Aabb near = surroundings(state, t, toucher, SeamScale{}.ahead);
    // These comparisons keep every side where the box is of no numbers.
    auto side = std::ranges::lower_bound(sides, near.lower[along], {}, place);
    for (; side != sides.end() && !(place(*side) > near.upper[along]); ++side) {
      const double beside = side->met[across];
      if (side->hidden || beside < near.lower[across] || beside > near.upper[across]) continue;
      side->hidden = isHiddenBy(state, scratch, t, seams[side->seam]);
    }
  }
}

/// Contacts are in the order of their bodies: the seams of one body are a run.
std::span<const SeamContact> seamsOfBody(const State& state, std::span<const SeamContact> seams,
                                         BodyId body) {
  const auto of = [&](const SeamContact& t) { return bodyOf(state, t); };
  const auto first = std::ranges::lower_bound(seams, body, {}, of);
  const auto isOther = [&](const SeamContact& t) { return of(t) != body; };
  return {first, std::find_if(first, seams.end(), isOther)};
}

/// Lists the covers that are fixed to the sides at `s`, those with the same direction up one behind
/// the other.
void listFixedCovers(const State& state, Scratch& scratch, std::span<const SeamContact> seams,
                     const SeamContact& s) {
  std::vector<FixedCover>& covers = scratch.fixed_covers;
  covers.clear();
  const std::uint32_t fixed = fixedTo(state, s);
  const auto run = fixed == kNone ? seams : seamsOfBody(state, seams, bodyOf(state, s));
  if (run.size() < 2) return;
  for (const SeamContact& t : run) {
    if (contactOf(state, t).count == 0 || fixedTo(state, t) != fixed) continue;
    const auto seam = static_cast<std::uint32_t>(&t - seams.data());
    covers.push_back({Ground(state, scratch, t).up, seam});
  }
  std::ranges::sort(covers, {},
                    [](const FixedCover& t) { return std::tuple(t.up.x(), t.up.y(), t.seam); });
  for (std::size_t i = covers.size(); i-- > 0;) {
    const bool last = i + 1 == covers.size() || covers[i].up != covers[i + 1].up;
    covers[i].end = last ? static_cast<std::uint32_t>(i + 1) : covers[i + 1].end;
  }
}

/// True when one of the listed covers hides the sides at `s`: it may be anywhere along the toucher,
/// but a side that lies along its ground is not hidden (isMetBySliding). Where a plank lies on N
/// tiles, all have one direction.
bool isHiddenByFixed(const State& state, const Scratch& scratch, std::span<const SeamContact> seams,
                     const SeamContact& s) {
  const std::vector<FixedCover>& covers = scratch.fixed_covers;
  if (covers.size() < 2) return false;
  const Vec2 normal = Ground(state, scratch, s).up;
  for (std::size_t i = 0; i < covers.size(); i = covers[i].end) {
    if (liesAlong(normal, covers[i].up)) continue;
    const std::span alike(&covers[i], covers[i].end - i);
    const bool hidden = std::ranges::any_of(
        alike, [&](const FixedCover& t) { return isHiddenBy(state, scratch, seams[t.seam], s); });
    if (hidden) return true;
  }
  return false;
}

/// Empties the contacts with hidden sides of one toucher. A contact that was emptied hides no side
/// that is fixed to it: among these sides the order counts, and it is that of the contacts.
void dropHiddenSidesOf(State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  listLooseSides(state, scratch, seams);
  markBesideCovers(state, scratch, seams);
  std::vector<LooseSide>& sides = scratch.loose_sides;
  std::ranges::sort(sides, {}, [](const LooseSide& side) { return packed(side.fixed, side.seam); });
  for (auto side = sides.begin(); side != sides.end(); ++side) {
    if (side == sides.begin() || side->fixed != std::prev(side)->fixed) {
      listFixedCovers(state, scratch, seams, seams[side->seam]);
    }
    const SeamContact& s = seams[side->seam];
    if (!side->hidden && !isHiddenByFixed(state, scratch, seams, s)) continue;
    Contact& contact = contactOf(state, s);
    contact.count = 0, contact.quiet_steps = 0;
  }
}

}  // namespace

void dropHiddenSides(State& state, Scratch& scratch) {
  const std::vector<SeamContact>& seams = scratch.seams;
  listSeams(state, scratch);
  for (auto first = seams.begin(); first != seams.end();) {
    const auto last = std::find_if(
        first, seams.end(), [&](const SeamContact& s) { return s.toucher != first->toucher; });
    dropHiddenSidesOf(state, scratch, {&*first, static_cast<std::size_t>(last - first)});
    first = last;
  }
}

}  // namespace merge2d
