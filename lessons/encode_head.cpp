#include "lessons/encode_head.h"

#include <array>
#include <utility>

#include "lessons/body_text.h"
#include "lessons/encode.h"
#include "lessons/ledger.h"
#include "src2d/scene/load.h"
#include "src2d/trace/json_text.h"
#include "src2d/trace/parameters.h"

namespace merge2d {
namespace {

constexpr std::array kEventTypes = {EventType::Merge, EventType::Unmerge, EventType::Sleep,
                                    EventType::Wake,  EventType::Impact,  EventType::Emit,
                                    EventType::Break};

/// Points are given in the body's own frame, the page knows the one at its centre of mass.
Vec2 fromCentre(const Scene& scene, BodyIndex body, const Vec2& point) {
  return point - areaProperties(scene.bodies[body].shapes).centroid;
}

void writeSpring(JsonText& out, const Scene& scene, const SpringDesc& s) {
  const auto local = [&](BodyIndex body, const Vec2& anchor) {
    return fromCentre(scene, body, anchor);
  };
  const Vec2 from = local(s.body, s.anchor), to = s.to_body ? local(*s.to_body, s.to) : s.to;
  out.row(s.body, from.x(), from.y(), s.to_body ? static_cast<std::int64_t>(*s.to_body) : -1,
          to.x(), to.y());
}

/// The loads of a scene: forces and impulses on bodies.
void writeLoads(JsonText& out, const Scene& scene) {
  out.array("forces", scene.forces, [&](const ForceDesc& f) {
    const Vec2 at = fromCentre(scene, f.body, f.at);
    out.row(f.body, at.x(), at.y(), f.force.x(), f.force.y(), f.from, f.until);
  });
  out.array("impulses", scene.impulses, [&](const ImpulseDesc& i) {
    out.row(i.body, i.at.x(), i.at.y(), i.impulse.x(), i.impulse.y(), i.time);
  });
}

/// Of a long run the names alone: its events are packed columns, which hold indices of names.
void writeEvents(JsonText& out, const Recording& r) {
  static const std::vector<TimedEvent> kNoEvents;
  const bool packed = r.every > 1;
  out.array("events", packed ? kNoEvents : r.events, [&](const TimedEvent& e) {
    out.row(e.step, name(e.event.type), e.event.a, e.event.b, e.event.collection,
            name(e.event.reason));
  });
  if (!packed) return;
  out.field("keyframes", r.every);
  out.array("event_types", kEventTypes, [&](EventType type) { out.value(name(type)); });
  out.array("event_reasons", kEventReasons, [&](EventReason reason) { out.value(name(reason)); });
}

}  // namespace

std::string headOf(const Recording& r, const ColumnLegend& legend) {
  JsonText out;
  const Camera camera = cameraOf(r);
  out.open('{').field("scene", r.scene.name).field("title", r.scene.title);
  out.field("mode", name(r.mode)).field("full", r.detail == Detail::Full);
  out.field("h", r.scene.step).field("steps", r.steps).field("every", legend.every);
  out.key("gravity").value(r.scene.gravity);
  out.key("camera").row(camera.center.x(), camera.center.y(), camera.height);
  out.field("length", legend.length.quantum).field("angle", legend.angle.quantum);
  out.key("amount").row(legend.amount.floor, legend.amount.steps);
  out.field("toml", toToml(r.scene)).key("parameters");
  writeParameters(out, r.scene);
  out.array("bodies", r.bodies, [&](const BodyInfo& body) { writeBody(out, body); });
  out.array("criteria", legend.criteria, [&](const DecisionTrack* t) {
    out.open('{').field("stage", t->stage).field("criterion", t->criterion);
    out.field("equation", t->equation).field("threshold", t->threshold);
    out.field("needed", t->needed).close('}');
  });
  writeEvents(out, r);
  out.array("colors", r.colors, [&](const CollectionColor& c) { out.row(c.id, c.slot); });
  out.array("ledger", r.ledger, [&](const LedgerEntry& e) { writeLedger(out, e); });
  out.array("orders", r.orders, [&](const SweepOrder& order) {
    out.open('[').value(order.step).open('[');
    for (const NotedVisit& visit : order.visits) out.row(visit.a, visit.b, visit.depth);
    out.close(']').close(']');
  });
  out.array("inside", legend.inside,
            [&](const ImpulsesInside* inside) { out.row(inside->step, inside->contact.size()); });
  writeLoads(out, r.scene);
  out.array("springs", r.scene.springs, [&](const SpringDesc& s) { writeSpring(out, r.scene, s); });
  out.close('}');
  return std::string(out.text());
}

}  // namespace merge2d
