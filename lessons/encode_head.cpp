#include "lessons/encode_head.h"

#include <utility>

#include "lessons/encode.h"
#include "lessons/ledger.h"
#include "render/silhouette.h"
#include "src2d/trace/json_text.h"
#include "src2d/trace/parameters.h"

namespace merge2d {
namespace {

void writeBody(JsonText& out, const BodyInfo& body) {
  out.open('{').field("name", body.name).field("motion", name(body.motion));
  out.field("mass", body.mass).field("inertia", body.inertia);
  const Silhouette looks = silhouette(body.shapes);
  out.array("pieces", looks.pieces, [&](const Piece& piece) {
    out.open('[');
    if (piece.kind == Piece::Kind::Disc) {
      out.value(piece.frame.position.x()).value(piece.frame.position.y()).value(piece.radius);
    } else {
      for (const Vec2& v : piece.vertices) out.value(v);
    }
    out.close(']');
  });
  out.array("boundary", looks.boundary,
            [&](const Segment& s) { out.row(s.from.x(), s.from.y(), s.to.x(), s.to.y()); });
  out.close('}');
}

/// Anchors are given in the body's own frame, the page knows the one at its centre of mass.
void writeSpring(JsonText& out, const Scene& scene, const SpringDesc& s) {
  const auto local = [&](BodyIndex body, const Vec2& anchor) -> Vec2 {
    return anchor - areaProperties(scene.bodies[body].shapes).centroid;
  };
  const Vec2 from = local(s.body, s.anchor), to = s.to_body ? local(*s.to_body, s.to) : s.to;
  out.row(s.body, from.x(), from.y(), s.to_body ? static_cast<std::int64_t>(*s.to_body) : -1,
          to.x(), to.y());
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
  out.key("parameters");
  writeParameters(out, r.scene);
  out.array("bodies", r.bodies, [&](const BodyInfo& body) { writeBody(out, body); });
  out.array("criteria", legend.criteria, [&](const DecisionTrack* t) {
    out.open('{').field("stage", t->stage).field("criterion", t->criterion);
    out.field("equation", t->equation).field("threshold", t->threshold);
    out.field("needed", t->needed).close('}');
  });
  out.array("events", r.events, [&](const TimedEvent& e) {
    out.row(e.step, name(e.event.type), e.event.a, e.event.b, e.event.collection,
            name(e.event.reason));
  });
  out.array("colors", r.colors, [&](const CollectionColor& c) { out.row(c.id, c.slot); });
  out.array("ledger", r.ledger, [&](const LedgerEntry& e) { writeLedger(out, e); });
  out.array("orders", r.orders, [&](const SweepOrder& order) {
    out.open('[').value(order.step).open('[');
    for (const NotedVisit& visit : order.visits) out.row(visit.a, visit.b, visit.depth);
    out.close(']').close(']');
  });
  out.array("inside", legend.inside,
            [&](const ImpulsesInside* inside) { out.row(inside->step, inside->contact.size()); });
  out.array("springs", r.scene.springs, [&](const SpringDesc& s) { writeSpring(out, r.scene, s); });
  out.close('}');
  return std::string(out.text());
}

}  // namespace merge2d
